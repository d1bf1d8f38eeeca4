# Translations and the manual's text become part of the window's library. To bring translations up to date
# with the sources: cmake --build BUILD --target ostia_translations_update
find_package(Qt5 5.15 REQUIRED COMPONENTS LinguistTools)

# A resource file of these files, each under its name alone.
function(_ostia_resource name prefix)
  set(lines "")
  foreach(path IN LISTS ARGN)
    get_filename_component(alias "${path}" NAME)
    string(APPEND lines "    <file alias=\"${alias}\">${path}</file>\n")
  endforeach()
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${name}.qrc" CONTENT
"<RCC>\n  <qresource prefix=\"/${prefix}\">\n${lines}  </qresource>\n</RCC>\n")
endfunction()

file(GLOB OSTIA_TRANSLATIONS CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/translations/*.ts")
qt5_add_translation(OSTIA_QM ${OSTIA_TRANSLATIONS})
_ostia_resource(ostia_translations translations ${OSTIA_QM})
file(GLOB OSTIA_MANUAL CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/docs/manual/*.md")
_ostia_resource(ostia_help manual ${OSTIA_MANUAL})
qt5_add_resources(OSTIA_RESOURCES "${CMAKE_CURRENT_BINARY_DIR}/ostia_translations.qrc"
                  "${CMAKE_CURRENT_BINARY_DIR}/ostia_help.qrc")
target_sources(ostia_workstation PRIVATE ${OSTIA_RESOURCES} ${OSTIA_QM})
# Each has the same names in it.
set_source_files_properties(${OSTIA_RESOURCES} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
# With its pictures the window finds the manual where it is when installed: in share/ostia, seen from the program.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/share")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}/docs" "${PROJECT_BINARY_DIR}/share/ostia" SYMBOLIC)

file(GLOB_RECURSE OSTIA_WINDOW_SOURCES CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp" "${CMAKE_CURRENT_SOURCE_DIR}/*.h")
add_custom_target(ostia_translations_update
  COMMAND Qt5::lupdate -I "${CMAKE_CURRENT_SOURCE_DIR}" -locations none -no-obsolete -silent ${OSTIA_WINDOW_SOURCES}
          -ts "${CMAKE_CURRENT_SOURCE_DIR}/translations/ostia_de.ts"
  # English texts stand in the sources, but for their plurals.
  COMMAND Qt5::lupdate -I "${CMAKE_CURRENT_SOURCE_DIR}" -locations none -no-obsolete -silent -pluralonly ${OSTIA_WINDOW_SOURCES}
          -ts "${CMAKE_CURRENT_SOURCE_DIR}/translations/ostia_en.ts"
  COMMENT "Translations: new and changed texts")
