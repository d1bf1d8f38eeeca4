# Entries of ctest for the tests of a program. The start of a process costs more than most tests: by default the
# tests of a suite run in one process and are one entry, `room.Suite`. Of their own are entries, `room.Suite.Test`, of
# tests that may be skipped (ctest says it by name), that change or measure their process, and of suites that are
# long (they run beside each other).
include(GoogleTest)
set(OSTIA_LIST_SUITES "${CMAKE_CURRENT_LIST_DIR}/list_suites.cmake")

# ostia_suite_entries(TARGET PREFIX FILTER NAME value ...) adds an entry for each suite, as the program lists them when
# ctest begins. FILTER: which tests belong to them, as --gtest_filter takes it. NAME value: properties of the entries.
function(ostia_suite_entries target prefix filter)
  set(entries "${CMAKE_CURRENT_BINARY_DIR}/${target}.${prefix}")
  get_target_property(emulator ${target} CROSSCOMPILING_EMULATOR)
  if(NOT emulator)
    set(emulator "")
  endif()
  file(GENERATE OUTPUT "${entries}.include.cmake" CONTENT
"set(program [==[$<TARGET_FILE:${target}>]==])
set(entries [==[${entries}.cmake]==])
if(NOT EXISTS \"\${program}\")
  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)
  return()
endif()
if(NOT EXISTS \"\${entries}\" OR NOT \"\${entries}\" IS_NEWER_THAN \"\${program}\" OR NOT \"\${entries}\" IS_NEWER_THAN \"\${CMAKE_CURRENT_LIST_FILE}\")
  include([==[${OSTIA_LIST_SUITES}]==])
  ostia_list_suites(\"\${program}\" [==[${prefix}]==] [==[${filter}]==] \"\${entries}\"
    [==[${CMAKE_CURRENT_BINARY_DIR}]==] [==[${emulator}]==] [==[${ARGN}]==])
endif()
include(\"\${entries}\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${entries}.include.cmake")
endfunction()

# ostia_test_entries(TARGET PREFIX [FILTER pattern] [APART pattern ...] [WITHOUT pattern ...] PROPERTIES name value ...):
# an entry for each suite (of FILTER alone), and one for each test that a pattern of APART (Suite.*, Suite.Test) matches.
# WITHOUT: tests that have entries already. A skip within the entry of a suite is a failure: nobody would see it.
function(ostia_test_entries target prefix)
  cmake_parse_arguments(ARG "" "FILTER" "APART;WITHOUT;PROPERTIES" ${ARGN})
  if(NOT ARG_FILTER)
    set(ARG_FILTER "*")
  endif()
  list(JOIN ARG_APART ":" apart)
  if(apart)
    gtest_discover_tests(${target} TEST_PREFIX "${prefix}." DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
      TEST_FILTER "${apart}"
      PROPERTIES ${ARG_PROPERTIES} SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
  endif()
  list(APPEND ARG_WITHOUT ${ARG_APART})
  list(JOIN ARG_WITHOUT ":" without)
  if(without)
    string(APPEND ARG_FILTER "-${without}")
  endif()
  ostia_suite_entries(${target} ${prefix} "${ARG_FILTER}" ${ARG_PROPERTIES})
endfunction()
