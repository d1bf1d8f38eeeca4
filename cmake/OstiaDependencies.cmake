find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(CGAL REQUIRED QUIET)

# Debian ships nanoflann's config where CMake does not look.
find_package(nanoflann REQUIRED PATHS /usr/share/nanoflann/cmake)

# TetGen comes without a CMake config. It is AGPL-3: linked into the worker only.
find_path(TETGEN_INCLUDE_DIR tetgen.h REQUIRED)
find_library(TETGEN_LIBRARY tet REQUIRED)
add_library(ostia_tetgen INTERFACE)
target_include_directories(ostia_tetgen SYSTEM INTERFACE "${TETGEN_INCLUDE_DIR}")
target_compile_definitions(ostia_tetgen INTERFACE TETLIBRARY)
target_link_libraries(ostia_tetgen INTERFACE "${TETGEN_LIBRARY}")

# SuiteSparse's CHOLMOD comes without a CMake config. Its Modify and Supernodal modules are GPL.
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(ostia_cholmod INTERFACE)
target_include_directories(ostia_cholmod SYSTEM INTERFACE "${CHOLMOD_INCLUDE_DIR}")
target_link_libraries(ostia_cholmod INTERFACE "${CHOLMOD_LIBRARY}")

find_package(SQLite3 REQUIRED)

# libzip's own config asks for its command line tools, which Debian ships in other packages.
find_path(ZIP_INCLUDE_DIR zip.h REQUIRED)
find_library(ZIP_LIBRARY zip REQUIRED)
add_library(ostia_zip INTERFACE)
target_include_directories(ostia_zip SYSTEM INTERFACE "${ZIP_INCLUDE_DIR}")
target_link_libraries(ostia_zip INTERFACE "${ZIP_LIBRARY}")

find_path(ISAL_INCLUDE_DIR isa-l/igzip_lib.h REQUIRED)
find_library(ISAL_LIBRARY isal REQUIRED)
add_library(ostia_isal INTERFACE)
target_include_directories(ostia_isal SYSTEM INTERFACE "${ISAL_INCLUDE_DIR}")
target_link_libraries(ostia_isal INTERFACE "${ISAL_LIBRARY}")

# CGAL's target without the compile options and definitions of its own that it would spread.
add_library(ostia_cgal INTERFACE)
target_link_libraries(ostia_cgal INTERFACE CGAL::CGAL)

if(OSTIA_WITH_IMAGE_LIBRARIES)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(PANGOCAIRO REQUIRED IMPORTED_TARGET pangocairo cairo cairo-pdf cairo-svg)
  find_package(embree 3 REQUIRED)
  find_package(Qt5 5.15 REQUIRED COMPONENTS Widgets)
  find_package(VTK 9.1 REQUIRED
    COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMisc CommonMath CommonTransforms FiltersCore IOXML IOLegacy
               RenderingCore RenderingOpenGL2 RenderingFreeType RenderingVolume RenderingVolumeOpenGL2 GUISupportQt)
endif()

if(OSTIA_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  if(OSTIA_WITH_IMAGE_LIBRARIES)
    find_program(OSTIA_XVFB_RUN xvfb-run REQUIRED)
  endif()
endif()
if(OSTIA_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
