# cmake --install BUILD --prefix PREFIX [--component COMPONENT]. Components:
#   programs       the commands, the live viewer and the worker, their manual pages and completions
#   workstation    the window, its manual, desktop entry, icon and file type
#   development    libraries, headers, what find_package(Ostia) reads
#   itk            the header by which programs that use ITK, too, view volumes as its images
#   documentation  the texts of docs/
#   python         the package ostia, by its name alone (bindings/python)
# Nothing is installed that was not asked to be built; benchmarks and tests are not needed.
include(CMakePackageConfigHelpers)

# ostia_install_description(PROGRAM COMPONENT) The manual pages and completions that the program writes about itself.
function(ostia_install_description program component)
  set(share "${PROJECT_BINARY_DIR}/package/${program}")
  add_custom_command(OUTPUT "${share}.made"
    COMMAND ${program} --describe "${share}" COMMAND "${CMAKE_COMMAND}" -E touch "${share}.made"
    DEPENDS ${program} COMMENT "Manual pages and completions of ${program}" VERBATIM)
  add_custom_target(${program}-description ALL DEPENDS "${share}.made")
  add_dependencies(${OSTIA_PREFIX}programs ${program}-description)
  install(DIRECTORY "${share}/" DESTINATION "${CMAKE_INSTALL_DATADIR}" COMPONENT ${component} PATTERN "*-commands.json" EXCLUDE)
endfunction()

# The window's manual, and of the pictures of docs/ those that it shows.
function(ostia_install_manual)
  set(docs "${PROJECT_SOURCE_DIR}/docs")
  set(share "${CMAKE_INSTALL_DATADIR}/ostia")
  install(DIRECTORY "${docs}/manual" DESTINATION "${share}" COMPONENT workstation)
  file(GLOB pages "${docs}/manual/*.md")
  set(pictures "")
  foreach(page IN LISTS pages)
    file(READ "${page}" text)
    string(REGEX MATCHALL "\\(\\.\\./[^)]*\\.png\\)" found "${text}")
    list(APPEND pictures ${found})
  endforeach()
  list(REMOVE_DUPLICATES pictures)
  foreach(picture IN LISTS pictures)
    string(REGEX REPLACE "^.\\.\\./(.*)\\)$" "\\1" picture "${picture}")
    get_filename_component(folder "${picture}" DIRECTORY)
    install(FILES "${docs}/${picture}" DESTINATION "${share}/${folder}" COMPONENT workstation)
  endforeach()
endfunction()

# Programs.
foreach(program IN ITEMS ostia ostia-live)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT programs)
    ostia_install_description(${program} programs)
  endif()
endforeach()
install(TARGETS ostia-worker RUNTIME DESTINATION "${CMAKE_INSTALL_LIBEXECDIR}/ostia" COMPONENT programs)

# The workflow for a cohort, which calls the program.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/apps/ostia/workflow" DESTINATION "${CMAKE_INSTALL_DATADIR}/ostia" USE_SOURCE_PERMISSIONS COMPONENT programs)

# The window.
if(TARGET ostia-workstation)
  install(TARGETS ostia-workstation RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT workstation)
  ostia_install_description(ostia-workstation workstation)
  ostia_install_manual()
  set(id io.github.ostia.Workstation)
  set(desktop "${PROJECT_SOURCE_DIR}/packaging/desktop/${id}")
  install(FILES "${desktop}.desktop" DESTINATION "${CMAKE_INSTALL_DATADIR}/applications" COMPONENT workstation)
  install(FILES "${desktop}.metainfo.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/metainfo" COMPONENT workstation)
  install(FILES "${desktop}.mime.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/mime/packages" RENAME "${id}.xml"
          COMPONENT workstation)
  install(FILES "${desktop}.svg" DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps" COMPONENT workstation)
endif()

# Libraries.
set(version_file "${PROJECT_BINARY_DIR}/package/OstiaConfigVersion.cmake")
set(config_file "${PROJECT_BINARY_DIR}/package/OstiaConfig.cmake")
set(rooms_file "${PROJECT_BINARY_DIR}/package/OstiaRooms.cmake")
get_property(records GLOBAL PROPERTY OSTIA_ROOM_RECORDS)
get_property(linked GLOBAL PROPERTY OSTIA_LINKED_THIRD_PARTIES)
ostia_debian_packages(debian_packages ${linked})
list(JOIN debian_packages ", " debian_packages)
file(WRITE "${PROJECT_BINARY_DIR}/package/development-packages.txt" "${debian_packages}\n")
file(CONFIGURE OUTPUT "${rooms_file}" @ONLY CONTENT
     "# The rooms that are installed, in the order of their floors; what each uses of them and of third parties.\n@records@")
write_basic_package_version_file("${version_file}" COMPATIBILITY SameMinorVersion)
set(OSTIA_WORKER "${CMAKE_INSTALL_LIBEXECDIR}/ostia/ostia-worker")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/OstiaConfig.cmake.in" "${config_file}"
  INSTALL_DESTINATION "${OSTIA_CMAKE_DIR}" PATH_VARS OSTIA_WORKER
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
install(FILES "${version_file}" "${config_file}" "${rooms_file}" "${PROJECT_SOURCE_DIR}/cmake/OstiaThirdParty.cmake"
        DESTINATION "${OSTIA_CMAKE_DIR}" COMPONENT development)
foreach(room IN LISTS OSTIA_ROOMS)
  if(TARGET ostia_${room})
    add_dependencies(${OSTIA_PREFIX}programs ostia_${room})  # what is built for programs suffices to install all
    install(TARGETS ostia_${room} EXPORT ostia_${room}
            ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
            INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT ostia_${room} FILE OstiaRoom_${room}.cmake NAMESPACE Ostia:: DESTINATION "${OSTIA_CMAKE_DIR}"
            COMPONENT development)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/libs/${room}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
            COMPONENT development FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/bindings/itk/ostia/itk.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ostia" COMPONENT itk)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT development)

# Texts. The reference of the Python package is there where the target python_docs was built.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
install(DIRECTORY "${PROJECT_BINARY_DIR}/python-docs/" DESTINATION "${CMAKE_INSTALL_DOCDIR}/python" COMPONENT documentation
        OPTIONAL PATTERN ".buildinfo" EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/LICENSE"
        DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT documentation)
