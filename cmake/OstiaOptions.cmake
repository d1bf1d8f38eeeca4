set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
# What concerns all of a build is decided by the project that is built. The rest of this file holds for Ostia's own
# folders alone, also where it is part of another project.
if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
  endif()
  # -O2: -O3 costs build time and gains nothing measurable here.
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
  set(OSTIA_PREFIX "")
else()
  set(OSTIA_PREFIX ostia_)  # of targets with a common name
endif()

option(OSTIA_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(OSTIA_BENCHMARKS "Offer the benchmarks, built by the target of that name" ${PROJECT_IS_TOP_LEVEL})
option(OSTIA_WERROR "Treat warnings as errors" ${PROJECT_IS_TOP_LEVEL})
option(OSTIA_APPS "Build the programs, not only the libraries and their worker" ${PROJECT_IS_TOP_LEVEL})
option(OSTIA_INSTALL "Offer to install what is built" ${PROJECT_IS_TOP_LEVEL})
option(OSTIA_WITH_IMAGE_LIBRARIES "Build what needs VTK, GDCM, Cairo or Embree" ON)
set(OSTIA_PYTHON AUTO CACHE STRING "Build the Python package: ON, OFF, or AUTO, with the tests")
set_property(CACHE OSTIA_PYTHON PROPERTY STRINGS AUTO ON OFF)
option(OSTIA_ASAN "AddressSanitizer and UndefinedBehaviorSanitizer in our own libraries" OFF)

# Of the whole chain: the module needs all rooms below the views. With OSTIA_ASAN only where it is asked for: Python must
# then be started with LD_PRELOAD naming libasan.
set(OSTIA_PYTHON_BUILT "${OSTIA_PYTHON}")
if(OSTIA_PYTHON STREQUAL "AUTO")
  set(OSTIA_PYTHON_BUILT "${OSTIA_TESTS}")
  if(OSTIA_ASAN)
    set(OSTIA_PYTHON_BUILT OFF)
  endif()
endif()
if(NOT OSTIA_WITH_IMAGE_LIBRARIES)
  if(OSTIA_PYTHON STREQUAL "ON")
    message(FATAL_ERROR " The Python package needs OSTIA_WITH_IMAGE_LIBRARIES: configure with -DOSTIA_PYTHON=OFF")
  endif()
  set(OSTIA_PYTHON_BUILT OFF)
endif()

# Both are for speed alone; the preset `plain` builds without them, so that each source is seen to include what it uses.
option(OSTIA_UNITY "Compile a room's sources in batches" ON)
option(OSTIA_PCH "Compile headers that most sources read once for all" ON)

find_program(OSTIA_CCACHE ccache)
if(OSTIA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # With precompiled headers ccache finds again what it kept only where it is told that time stamps do not matter; what is
  # in the files does. What a source includes it is told by the compiler, which saves a run of the preprocessor.
  set(CMAKE_C_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${OSTIA_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_C_COMPILER_LAUNCHER})
endif()
find_program(OSTIA_MOLD mold)
if(OSTIA_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# Results must not depend on whether the compiler fuses multiply and add.
add_compile_options(-ffp-contract=off)
# The Python module holds the same objects as the programs, so all can be loaded anywhere. Nothing takes the place of a function
# of ours when a program is loaded, so calls within a source may be inlined as ever.
add_compile_options(-fPIC -fno-semantic-interposition)
# A program links only what it uses: the worker alone needs GDCM and TetGen.
add_link_options(-Wl,--as-needed)
if(OSTIA_ASAN)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  # GCC 12 takes std::regex for uninitialised once it is instrumented.
  add_compile_options(-Wno-maybe-uninitialized)
  add_link_options(-fsanitize=address,undefined)
endif()
