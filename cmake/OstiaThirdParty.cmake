# Where the target of each third party comes from and which Debian package has it. The build reads this file, and
# OstiaConfig.cmake does, beside which it is installed, so that both find the same.
#
# Each row: target | how it is found | Debian package. How is one of
#   package NAME [more of find_package's words]
#   pkgconfig MODULE...
#   library HEADER[:FOLDER of the header] LIBRARY...     which have no configuration for CMake that works on Debian 12
set(OSTIA_THIRD_PARTIES
  "Threads::Threads|package Threads|libc6-dev"
  "Eigen3::Eigen|package Eigen3 3.4 NO_MODULE|libeigen3-dev"
  "TBB::tbb|package TBB|libtbb-dev"
  "spdlog::spdlog|package spdlog|libspdlog-dev"
  "fmt::fmt|package fmt|libfmt-dev"
  "OpenSSL::Crypto|package OpenSSL COMPONENTS Crypto|libssl-dev"
  "ZLIB::ZLIB|package ZLIB|zlib1g-dev"
  "PNG::PNG|package PNG|libpng-dev"
  "SQLite::SQLite3|package SQLite3|libsqlite3-dev"
  "nlohmann_json::nlohmann_json|package nlohmann_json|nlohmann-json3-dev"
  "CLI11::CLI11|package CLI11|libcli11-dev"
  "CGAL::CGAL|package CGAL|libcgal-dev"
  # Debian ships nanoflann's configuration where CMake does not look.
  "nanoflann::nanoflann|package nanoflann PATHS /usr/share/nanoflann/cmake|libnanoflann-dev"
  "embree|package embree 3|libembree-dev"
  # TetGen is AGPL-3: linked into the worker only.
  "OstiaThirdParty::tetgen|library tetgen.h tet|libtet1.5-dev"
  # Its Modify and Supernodal modules are GPL.
  "OstiaThirdParty::cholmod|library cholmod.h:suitesparse cholmod|libsuitesparse-dev"
  # libzip's own configuration asks for its command line tools, which Debian ships in other packages.
  "OstiaThirdParty::zip|library zip.h zip|libzip-dev"
  "OstiaThirdParty::isal|library isa-l/igzip_lib.h isal|libisal-dev"
  "OstiaThirdParty::gdcm|library gdcmImage.h:gdcm-3.0 gdcmMSFF gdcmDSED gdcmCommon|libgdcm-dev"
  "OstiaThirdParty::dcmtk|library dcmtk/config/osconfig.h dcmnet dcmtls dcmdata oflog ofstd|libdcmtk-dev"
  "OstiaThirdParty::curl|library curl/curl.h curl|libcurl4-openssl-dev"
  "OstiaThirdParty::cgns|library cgnslib.h cgns|libcgns-dev"
  # Its own configuration loads every module, and with them what they need of other packages.
  "OstiaThirdParty::itk|library itkImage.h:ITK-5.2 ITKOptimizers-5.2 ITKSmoothing-5.2 ITKTransform-5.2 ITKStatistics-5.2 ITKCommon-5.2 ITKVNLInstantiation-5.2 itkvnl_algo-5.2 itkvnl-5.2 itksys-5.2|libinsighttoolkit5-dev"
  "OstiaThirdParty::itk_filters|library itkImage.h:ITK-5.2 ITKBiasCorrection-5.2 ITKMathematicalMorphology-5.2 ITKImageFeature-5.2 ITKFastMarching-5.2 ITKSmoothing-5.2 ITKStatistics-5.2 ITKTransform-5.2 ITKCommon-5.2 ITKVNLInstantiation-5.2 itkvnl_algo-5.2 itkvnl-5.2 itksys-5.2|libinsighttoolkit5-dev"
  "OstiaThirdParty::itk_readers|library itkImage.h:ITK-5.2 ITKIOGIPL-5.2 ITKIOTIFF-5.2 ITKIOVTK-5.2 ITKIONIFTI-5.2 ITKIOHDF5-5.2 ITKIOImageBase-5.2 ITKCommon-5.2 itkvnl-5.2 itksys-5.2|libinsighttoolkit5-dev"
  # All that is left of CGAL when its headers are compiled.
  "OstiaThirdParty::gmp|library gmp.h gmp|libgmp-dev"
  "OstiaThirdParty::mpfr|library mpfr.h mpfr|libmpfr-dev"
  "PkgConfig::PANGOCAIRO|pkgconfig pangocairo cairo cairo-pdf cairo-svg|libpango1.0-dev"
  "PkgConfig::HDF5_SERIAL|pkgconfig hdf5-serial|libhdf5-dev"
  "PkgConfig::NETCDF|pkgconfig netcdf|libnetcdf-dev"
  "PkgConfig::EPOXY|pkgconfig epoxy|libepoxy-dev"
  "Qt5::Widgets|package Qt5 5.15 COMPONENTS Widgets|qtbase5-dev"
  "qt5keychain|package Qt5Keychain|qtkeychain-qt5-dev"
  "Qt5::lrelease|package Qt5 5.15 COMPONENTS LinguistTools|qttools5-dev"
  "pybind11::headers|package pybind11 2.10|pybind11-dev"
  # Headers alone: who loads the module has the library.
  "OstiaThirdParty::python|library Python.h:python3.11|python3-dev"
  "GTest::gtest|package GTest|libgtest-dev"
  "benchmark::benchmark|package benchmark|libbenchmark-dev")

# ostia_library_target(TARGET HEADER[:FOLDER] LIBRARY...): no target where any of it is missing.
function(_ostia_library_target target header)
  string(REGEX REPLACE ".*:" "" name "${target}")
  string(TOUPPER "OSTIA_${name}" prefix)
  string(REPLACE ":" ";" header "${header}")
  list(POP_FRONT header file)
  find_path(${prefix}_INCLUDE_DIR "${file}" PATH_SUFFIXES ${header})
  mark_as_advanced(${prefix}_INCLUDE_DIR)
  set(files "")
  foreach(library IN LISTS ARGN)
    find_library(${prefix}_LIBRARY_${library} ${library})
    mark_as_advanced(${prefix}_LIBRARY_${library})
    list(APPEND files "${${prefix}_LIBRARY_${library}}")
  endforeach()
  if(NOT ${prefix}_INCLUDE_DIR OR files MATCHES "NOTFOUND")
    return()
  endif()
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} INTERFACE "${${prefix}_INCLUDE_DIR}")
  target_link_libraries(${target} INTERFACE ${files})
endfunction()

# ostia_debian_packages(VARIABLE TARGET...) Those that have these targets.
function(ostia_debian_packages variable)
  set(packages "")
  foreach(target IN LISTS ARGN)
    if(target STREQUAL "VTK::GUISupportQt")
      list(APPEND packages libvtk9-qt-dev)
    elseif(target MATCHES "^VTK::")
      list(APPEND packages libvtk9-dev)
    else()
      set(row "${OSTIA_THIRD_PARTIES}")
      list(FILTER row INCLUDE REGEX "^${target}\\|")
      string(REGEX REPLACE ".*\\|" "" package "${row}")
      list(APPEND packages ${package})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES packages)
  set(${variable} "${packages}" PARENT_SCOPE)
endfunction()

# ostia_find_third_parties(MISSING TARGET...) Makes those targets that are not there. MISSING becomes the list of the
# Debian packages of those that were not found. VTK's modules, VTK::name, are asked for in one go. A macro, since
# packages leave variables that their users need.
macro(ostia_find_third_parties missing)
  set(_ostia_not_found "")
  set(_ostia_asked ${ARGN})
  set(_ostia_vtk_modules ${_ostia_asked})
  list(FILTER _ostia_vtk_modules INCLUDE REGEX "^VTK::")
  list(FILTER _ostia_asked EXCLUDE REGEX "^VTK::")
  foreach(_ostia_target IN LISTS _ostia_asked)
    if(TARGET ${_ostia_target})
      continue()
    endif()
    set(_ostia_row "${OSTIA_THIRD_PARTIES}")
    list(FILTER _ostia_row INCLUDE REGEX "^${_ostia_target}\\|")
    string(REPLACE "|" ";" _ostia_row "${_ostia_row}")
    list(GET _ostia_row 1 _ostia_how)
    string(REPLACE " " ";" _ostia_how "${_ostia_how}")
    list(POP_FRONT _ostia_how _ostia_kind)
    if(_ostia_kind STREQUAL "package")
      find_package(${_ostia_how} QUIET)
    elseif(_ostia_kind STREQUAL "pkgconfig")
      find_package(PkgConfig QUIET)
      if(PKG_CONFIG_FOUND)
        string(REPLACE "PkgConfig::" "" _ostia_prefix "${_ostia_target}")
        pkg_check_modules(${_ostia_prefix} QUIET IMPORTED_TARGET GLOBAL ${_ostia_how})
      endif()
    else()
      _ostia_library_target(${_ostia_target} ${_ostia_how})
    endif()
    if(NOT TARGET ${_ostia_target})
      list(APPEND _ostia_not_found ${_ostia_target})
    endif()
  endforeach()
  if(_ostia_vtk_modules)
    list(TRANSFORM _ostia_vtk_modules REPLACE "^VTK::" "")
    find_package(VTK 9.1 QUIET COMPONENTS ${_ostia_vtk_modules})
    if(NOT VTK_FOUND)
      list(TRANSFORM _ostia_vtk_modules PREPEND "VTK::")
      list(APPEND _ostia_not_found ${_ostia_vtk_modules})
    endif()
  endif()
  ostia_debian_packages(${missing} ${_ostia_not_found})
endmacro()
