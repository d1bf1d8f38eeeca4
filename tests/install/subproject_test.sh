#!/usr/bin/env bash
# subproject_test.sh SOURCE IMAGES: Ostia as a part of another project leaves that project's settings alone. IMAGES is ON where
# VTK and its like are installed; without them it is tried in any case.
source "$(dirname "$0")/common.sh"
source=$1 images=$2
mkdir "$work/parent"
cat > "$work/parent/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(parent LANGUAGES C CXX)
add_subdirectory("${OSTIA_SOURCE}" ostia EXCLUDE_FROM_ALL)
file(WRITE "${CMAKE_BINARY_DIR}/main.cpp" "#include <ostia/core/version.h>\nint main() { return ostia::core::version().empty(); }\n")
add_executable(program main.cpp)
set_property(TARGET program PROPERTY SOURCES "${CMAKE_BINARY_DIR}/main.cpp")
target_link_libraries(program PRIVATE Ostia::core Ostia::lumen ostia::meshing)
foreach(variable IN ITEMS CMAKE_BUILD_TYPE CMAKE_CXX_STANDARD CMAKE_RUNTIME_OUTPUT_DIRECTORY CMAKE_CXX_COMPILER_LAUNCHER)
  if(NOT "${${variable}}" STREQUAL "")
    message(SEND_ERROR "${variable} has become ${${variable}}")
  endif()
endforeach()
if(NOT CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
  message(SEND_ERROR "CMAKE_CXX_FLAGS_RELEASE has become ${CMAKE_CXX_FLAGS_RELEASE}")
endif()
get_directory_property(options COMPILE_OPTIONS)
get_directory_property(links LINK_OPTIONS)
if(options OR links)
  message(SEND_ERROR "options of all targets have become ${options} ${links}")
endif()
foreach(target IN ITEMS programs benchmarks test_core_unit ostia ostia-workstation)
  if(TARGET ${target})
    message(SEND_ERROR "there is a target ${target}")
  endif()
endforeach()
foreach(target IN ITEMS Ostia::lumen ostia::lumen ostia-worker)
  if(NOT TARGET ${target})
    message(SEND_ERROR "there is no target ${target}")
  endif()
endforeach()
END
configure() {
  cmake -G Ninja -S "$work/parent" -B "$work/build" -DOSTIA_SOURCE="$source" -DOSTIA_WITH_IMAGE_LIBRARIES="$1" > "$work/log" 2>&1 ||
    { cat "$work/log"; fail "the project around Ostia is not configured (image libraries $1)"; }
}
[ "$images" != ON ] || configure ON
configure OFF
grep -q '\-ffp-contract=off.*core/src/version.cpp' <(ninja -C "$work/build" -t commands ostia_core) || fail "Ostia's own flags are not used for its own sources"
if ninja -C "$work/build" -t commands program | grep main.cpp | grep -q -e -ffp-contract; then fail "Ostia's flags are used for the program"; fi
if ninja -C "$work/build" -t targets all | grep -q '^install:'; then
  ! cmake --install "$work/build" --prefix "$work/prefix" > /dev/null 2>&1 || [ ! -d "$work/prefix" ] || fail "Ostia is installed with the project around it"
fi
