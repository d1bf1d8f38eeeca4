# What the Python module links. A module is loaded anywhere in memory, and the rooms' objects are not made for that. With
# OSTIA_PIC all of the build is, and the module links the rooms themselves; else each room that it uses is compiled a second
# time, for it alone: ostia_movable_<room>, made by no other target.
if(OSTIA_PYTHON_BUILT AND NOT OSTIA_PIC)
  set(_ostia_movable_properties POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(OSTIA_PCH)
    _ostia_precompile(ostia_movable_headers ${_ostia_source_headers})
    set_target_properties(ostia_movable_headers PROPERTIES ${_ostia_movable_properties} EXCLUDE_FROM_ALL ON)
  endif()
endif()

# ostia_movable_library(NAME SOURCES source ... [USES room ...] [PUBLIC target ...] [PRIVATE target ...]), as ostia_library has
# them. The room's own definitions are the copy's, too.
function(ostia_movable_library name)
  if(NOT OSTIA_PYTHON_BUILT OR OSTIA_PIC)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  set(copy ostia_movable_${name})
  add_library(${copy} STATIC EXCLUDE_FROM_ALL ${ARG_SOURCES})
  set_target_properties(${copy} PROPERTIES ${_ostia_movable_properties})
  target_include_directories(${copy} PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}/include" PRIVATE src)
  target_compile_definitions(${copy} PRIVATE "$<TARGET_PROPERTY:ostia_${name},COMPILE_DEFINITIONS>")
  list(TRANSFORM ARG_USES PREPEND "ostia_movable_")
  target_link_libraries(${copy} PUBLIC ${ARG_USES} ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  ostia_warnings(${copy})
  ostia_compile_fast(${copy} movable)
endfunction()

# ostia_movable_target(VARIABLE NAME) What a module links of a room.
function(ostia_movable_target variable name)
  if(OSTIA_PIC)
    set(${variable} "ostia_${name}" PARENT_SCOPE)
  else()
    set(${variable} "ostia_movable_${name}" PARENT_SCOPE)
  endif()
endfunction()
