set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# -O2: -O3 costs build time and gains nothing measurable here.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

option(OSTIA_TESTS "Build the tests" ON)
option(OSTIA_BENCHMARKS "Offer the benchmarks, built by the target of that name" ON)
option(OSTIA_WERROR "Treat warnings as errors" ON)
option(OSTIA_WITH_IMAGE_LIBRARIES "Build what needs VTK, GDCM, Cairo or Embree" ON)
option(OSTIA_ASAN "AddressSanitizer and UndefinedBehaviorSanitizer in our own libraries" OFF)

# Both are for speed alone; the preset `plain` builds without them, so that each source is seen to include what it uses.
option(OSTIA_UNITY "Compile a room's sources in batches" ON)
option(OSTIA_PCH "Compile headers that most sources read once for all" ON)

find_program(OSTIA_CCACHE ccache)
if(OSTIA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # With precompiled headers ccache finds again what it kept only where it is told that time stamps do not matter; what is
  # in the files does.
  set(CMAKE_C_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${OSTIA_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_C_COMPILER_LAUNCHER})
endif()
find_program(OSTIA_MOLD mold)
if(OSTIA_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# Results must not depend on whether the compiler fuses multiply and add.
add_compile_options(-ffp-contract=off)
# A program links only what it uses: the worker alone needs GDCM and TetGen.
add_link_options(-Wl,--as-needed)
if(OSTIA_ASAN)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  # GCC 12 takes std::regex for uninitialised once it is instrumented.
  add_compile_options(-Wno-maybe-uninitialized)
  add_link_options(-fsanitize=address,undefined)
endif()
