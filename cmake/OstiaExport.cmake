# What other projects see of a room: the target Ostia::room, in the build tree and where Ostia is installed.
include(GNUInstallDirs)
set(OSTIA_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Ostia")

# Headers alone: whoever links a room does not need them.
set(_ostia_headers_alone nlohmann_json::nlohmann_json nanoflann::nanoflann)

# What a room's third parties, as the build knows them, are for who links the installed room.
function(_ostia_linked_third_parties variable)
  set(linked ${ARGN})
  list(REMOVE_ITEM linked ${_ostia_headers_alone})
  list(TRANSFORM linked REPLACE "^ostia_cgal$" "OstiaThirdParty::gmp;OstiaThirdParty::mpfr")
  set(${variable} "${linked}" PARENT_SCOPE)
endfunction()

# ostia_export_room(NAME [USES room ...] [PUBLIC target ...] [PRIVATE target ...]), as ostia_library has them. Notes in
# OSTIA_ROOM_RECORDS what find_package must know of it.
function(ostia_export_room name)
  cmake_parse_arguments(ARG "" "" "USES;PUBLIC;PRIVATE" ${ARGN})
  add_library(Ostia::${name} ALIAS ostia_${name})
  set_target_properties(ostia_${name} PROPERTIES EXPORT_NAME ${name} INTERFACE_COMPILE_FEATURES cxx_std_20)
  _ostia_linked_third_parties(linked ${ARG_PUBLIC} ${ARG_PRIVATE})
  list(FILTER linked INCLUDE REGEX "::|^embree$")
  set_property(GLOBAL APPEND PROPERTY OSTIA_LINKED_THIRD_PARTIES ${linked})
  set_property(GLOBAL APPEND_STRING PROPERTY OSTIA_ROOM_RECORDS
    "list(APPEND _ostia_rooms ${name})\nset(_ostia_uses_${name} ${ARG_USES})\nset(_ostia_third_parties_of_${name} ${linked})\n")
endfunction()

# ostia_link_privately(NAME target ...) links third parties that stand in .cpp files alone: in this build with their
# headers, where the room is installed with their libraries.
function(ostia_link_privately name)
  foreach(target IN LISTS ARGN)
    _ostia_linked_third_parties(linked ${target})
    if(linked STREQUAL target)
      target_link_libraries(ostia_${name} PRIVATE ${target})
    else()
      target_link_libraries(ostia_${name} PRIVATE "$<BUILD_INTERFACE:${target}>")
      foreach(library IN LISTS linked)
        target_link_libraries(ostia_${name} PRIVATE "$<INSTALL_INTERFACE:${library}>")
      endforeach()
    endif()
  endforeach()
endfunction()
