# Headers that most sources read, compiled once for all of them. Each source still includes what it uses; with
# OSTIA_PCH off the compiler sees nothing else.
set(_ostia_source_headers
    <Eigen/Dense> <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory>
    <numbers> <optional> <set> <string> <utility> <vector>)
set(_ostia_test_headers ${_ostia_source_headers} <gmock/gmock.h> <gtest/gtest.h>)
set(_ostia_window_headers ${_ostia_source_headers} <QtWidgets>)

# With the flags of all targets: one that differs is told by -Winvalid-pch.
function(_ostia_precompile name)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/${name}.cpp" CONTENT "")
  add_library(${name} OBJECT "${PROJECT_BINARY_DIR}/${name}.cpp")
  target_link_libraries(${name} PRIVATE Eigen3::Eigen)
  target_precompile_headers(${name} PRIVATE ${ARGN})
  ostia_warnings(${name})
endfunction()

if(OSTIA_PCH)
  # All targets must agree on it, and some libraries ask for it.
  add_compile_options(-pthread)
  # What ccache needs to know what a precompiled header brought.
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
  # GCC 12 no longer knows that std::string is the system's own once it comes precompiled, and warns of what it
  # takes for overflows there. Builds without precompiled headers keep these warnings.
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-array-bounds>
                      $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-stringop-overflow>
                      $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-stringop-overread>
                      $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict>)
  _ostia_precompile(ostia_source_headers ${_ostia_source_headers})
  if(OSTIA_TESTS)
    _ostia_precompile(ostia_test_headers ${_ostia_test_headers})
    target_link_libraries(ostia_test_headers PRIVATE GTest::gmock GTest::gtest)
  endif()
  if(OSTIA_WITH_IMAGE_LIBRARIES AND OSTIA_APPS)
    _ostia_precompile(ostia_window_headers ${_ostia_window_headers})
    target_link_libraries(ostia_window_headers PRIVATE Qt5::Widgets)
  endif()
endif()

# ostia_compile_fast(TARGET KIND [BATCH n]): in batches of n sources, with the precompiled headers of KIND source, test
# or window (Qt's). What a batch costs is what a change of one of its sources costs, too.
function(ostia_compile_fast target kind)
  cmake_parse_arguments(ARG "" "BATCH" "" ${ARGN})
  if(NOT ARG_BATCH)
    set(ARG_BATCH 8)
  endif()
  if(OSTIA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${ARG_BATCH})
  endif()
  if(OSTIA_PCH)
    target_precompile_headers(${target} REUSE_FROM ostia_${kind}_headers)
  endif()
endfunction()
