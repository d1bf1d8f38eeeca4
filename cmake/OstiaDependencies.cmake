include(OstiaThirdParty)
if(NOT PROJECT_IS_TOP_LEVEL)
  set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # the project around this one links them, too
endif()

set(_ostia_needed
    Threads::Threads Eigen3::Eigen TBB::tbb spdlog::spdlog fmt::fmt OpenSSL::Crypto ZLIB::ZLIB nlohmann_json::nlohmann_json
    CGAL::CGAL nanoflann::nanoflann SQLite::SQLite3 OstiaThirdParty::tetgen OstiaThirdParty::cholmod OstiaThirdParty::zip
    OstiaThirdParty::isal)
if(OSTIA_APPS)
  list(APPEND _ostia_needed CLI11::CLI11)
endif()
if(OSTIA_WITH_IMAGE_LIBRARIES)
  list(APPEND _ostia_needed PkgConfig::PANGOCAIRO PNG::PNG PkgConfig::HDF5_SERIAL PkgConfig::NETCDF embree OstiaThirdParty::gdcm
       OstiaThirdParty::cgns OstiaThirdParty::dcmtk OstiaThirdParty::curl OstiaThirdParty::itk OstiaThirdParty::itk_filters OstiaThirdParty::itk_readers)
  foreach(module IN ITEMS CommonCore CommonDataModel CommonExecutionModel CommonMisc CommonMath CommonTransforms FiltersCore
          IOXML IOLegacy RenderingCore RenderingOpenGL2 RenderingFreeType RenderingVolume RenderingVolumeOpenGL2)
    list(APPEND _ostia_needed VTK::${module})
  endforeach()
  if(OSTIA_APPS)
    list(APPEND _ostia_needed Qt5::Widgets Qt5::lrelease qt5keychain VTK::GUISupportQt)
  endif()
endif()
if(OSTIA_PYTHON_BUILT)
  set(PYBIND11_NOPYTHON ON)  # it would take the first Python on the path; the package is for the system's own
  list(APPEND _ostia_needed pybind11::headers OstiaThirdParty::python)
endif()
if(OSTIA_TESTS)
  list(APPEND _ostia_needed GTest::gtest)
endif()
if(OSTIA_BENCHMARKS)
  list(APPEND _ostia_needed benchmark::benchmark)
endif()

ostia_find_third_parties(_ostia_missing ${_ostia_needed})
if(OSTIA_TESTS AND OSTIA_WITH_IMAGE_LIBRARIES)
  find_program(OSTIA_XVFB_RUN xvfb-run)
  if(NOT OSTIA_XVFB_RUN)
    list(APPEND _ostia_missing xvfb)
  endif()
endif()
if(_ostia_missing)
  list(JOIN _ostia_missing " " _ostia_missing)
  # CMake breaks the lines of a text unless it begins with a blank.
  message(FATAL_ERROR " Packages are missing; scripts/build.sh installs what it needs, or install them by: apt install ${_ostia_missing}")
endif()
if(OSTIA_TESTS)
  include(GoogleTest)
endif()
target_compile_definitions(OstiaThirdParty::tetgen INTERFACE TETLIBRARY)
foreach(target IN ITEMS OstiaThirdParty::itk OstiaThirdParty::itk_filters OstiaThirdParty::itk_readers)
  if(TARGET ${target})
    # Its own copy of Eigen is an older one: the two do not go into one source.
    target_compile_definitions(${target} INTERFACE ITK_USE_SYSTEM_EIGEN)
  endif()
endforeach()

# CGAL's headers are compiled into our libraries. Who links those installed needs only what is below CGAL.
add_library(ostia_cgal INTERFACE)
target_link_libraries(ostia_cgal INTERFACE CGAL::CGAL)
