# The rooms, floor by floor from the ground up and left to right. The order is the rule: a room may use
# only rooms that stand before it here (phantom and evaluation: ground and data alone).
set(OSTIA_ROOMS
    core geometry
    imaging dicom pacs reformat io figure
    filtering registration segmentation centerline reconstruction lumen meshing hemodynamics solver motion analysis
    phantom evaluation coronary pipeline
    session experiments cohort
    glview view)

function(ostia_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor)
  if(OSTIA_UNITY)
    # In a batch a name of the neighbouring source is no name that is hidden, and no source is a header.
    target_compile_options(${target} PRIVATE -Wshadow=local -Wno-subobject-linkage)
  else()
    target_compile_options(${target} PRIVATE -Wshadow)
  endif()
  if(OSTIA_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

include(OstiaPrecompiled)
include(OstiaExport)
include(OstiaTestEntries)

function(_ostia_leak_suppressions target)
  if(OSTIA_ASAN)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/leak_suppressions.cpp)
  endif()
endfunction()

# ostia_library(NAME SOURCES a.cpp ... [USES room ...] [PUBLIC target ...] [PRIVATE target ...])
# USES names other rooms; PUBLIC and PRIVATE name third parties.
function(ostia_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  list(TRANSFORM ARG_SOURCES PREPEND "src/")
  add_library(ostia_${name} STATIC ${ARG_SOURCES})
  add_library(ostia::${name} ALIAS ostia_${name})
  target_include_directories(ostia_${name} PUBLIC "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>" PRIVATE src)
  ostia_export_room(${name} USES ${ARG_USES} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  list(TRANSFORM ARG_USES PREPEND "ostia::")
  target_link_libraries(ostia_${name} PUBLIC ${ARG_USES} ${ARG_PUBLIC})
  ostia_link_privately(${name} ${ARG_PRIVATE})
  ostia_warnings(ostia_${name})
  ostia_compile_fast(ostia_${name} source)
endfunction()

# ostia_avx2_sources(a.cpp ...) Sources of a room with the same loops for newer processors, which core/processor.h
# chooses when the program runs; the results do not depend on the choice.
function(ostia_avx2_sources)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(TRANSFORM ARGN PREPEND "src/")
    set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS "-mavx2")
  endif()
endfunction()

# ostia_program(NAME SOURCES a.cpp ... LINKS target ... [HEADERS window]), which are those to be precompiled.
function(ostia_program name)
  cmake_parse_arguments(ARG "" "HEADERS" "SOURCES;LINKS" ${ARGN})
  if(NOT ARG_HEADERS)
    set(ARG_HEADERS source)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS})
  ostia_warnings(${name})
  ostia_compile_fast(${name} ${ARG_HEADERS})
  _ostia_leak_suppressions(${name})
endfunction()

# ostia_tests(ROOM [UNIT a_test.cpp ...] [REAL b_real_test.cpp ...] [SLOW ...] [GUI ...] [LINKS target ...] [COST s] [APART pattern ...])
# Each kind becomes one program and carries its ctest label. GUI tests open windows: each runs under an X
# server of its own, beside other tests. The server must not start anew when its last client leaves (-noreset):
# the next one would be turned away meanwhile. COST: the seconds of the longest entry, where that is more than a
# few; ctest starts these first, so that no processor waits for one of them at the end. Suites of UNIT and GUI are one entry
# each, but for what APART names (OstiaTestEntries.cmake); all other tests are processes and entries of their own.
function(ostia_tests room)
  cmake_parse_arguments(ARG "" "COST" "UNIT;REAL;SLOW;GUI;LINKS;APART" ${ARGN})
  if(NOT ARG_COST)
    set(ARG_COST 0)
  endif()
  foreach(kind UNIT REAL SLOW GUI)
    if(NOT ARG_${kind})
      continue()
    endif()
    string(TOLOWER ${kind} label)
    set(target test_${room}_${label})
    add_executable(${target} ${ARG_${kind}})
    target_link_libraries(${target} PRIVATE ostia::${room} ostia_test_support GTest::gtest GTest::gmock
                                            GTest::gtest_main ${ARG_LINKS})
    ostia_warnings(${target})
    ostia_compile_fast(${target} test)
    _ostia_leak_suppressions(${target})
    set(most_s 600)
    if(kind STREQUAL "SLOW")
      set(most_s 3600)
    endif()
    if(kind STREQUAL "GUI")
      set_target_properties(${target} PROPERTIES
        CROSSCOMPILING_EMULATOR "${OSTIA_XVFB_RUN};-a;-s;-screen 0 1600x1200x24 -noreset")
    endif()
    set(properties LABELS ${label} TIMEOUT ${most_s} COST ${ARG_COST})
    if(kind MATCHES "UNIT|GUI")
      ostia_test_entries(${target} ${room} APART ${ARG_APART} PROPERTIES ${properties})
    else()
      gtest_discover_tests(${target} TEST_PREFIX "${room}." DISCOVERY_MODE PRE_TEST
        PROPERTIES ${properties} SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
    endif()
  endforeach()
endfunction()

# ostia_benchmark(ROOM SOURCES a_bench.cpp ... [LINKS target ...]) -> target bench_<room>
function(ostia_benchmark room)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(bench_${room} ${ARG_SOURCES})
  target_link_libraries(bench_${room} PRIVATE ostia::${room} ostia_test_support benchmark::benchmark ${ARG_LINKS})
  ostia_warnings(bench_${room})
  ostia_compile_fast(bench_${room} source)
  set_target_properties(bench_${room} PROPERTIES UNITY_BUILD OFF)  # each has a scene of its own
endfunction()
