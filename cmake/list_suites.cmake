# Run by ctest before it tests: see OstiaTestEntries.cmake.

# ostia_list_suites(program prefix filter file folder emulator properties) writes `add_test` for each suite of `program`
# that has tests within `filter` (as --gtest_filter takes it) into `file`.
function(ostia_list_suites program prefix filter file folder emulator properties)
  execute_process(COMMAND ${emulator} "${program}" --gtest_list_tests "--gtest_filter=${filter}"
    WORKING_DIRECTORY "${folder}" TIMEOUT 60 OUTPUT_VARIABLE listed RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${program} does not list its tests (${result}):\n${listed}")
  endif()
  string(REGEX MATCH "-.*$" left_out "${filter}")
  string(REGEX MATCHALL "(^|\n)[A-Za-z_][A-Za-z0-9_/]*\\." suites "${listed}")
  set(command)
  foreach(word IN LISTS emulator)
    string(APPEND command "[==[${word}]==] ")
  endforeach()
  set(script)
  foreach(suite IN LISTS suites)
    string(REGEX REPLACE "[\n.]" "" suite "${suite}")
    set(name "[==[${prefix}.${suite}]==]")
    string(APPEND script "add_test(${name} ${command}[==[${program}]==] [==[--gtest_filter=${suite}.*${left_out}]==])\n"
      "set_tests_properties(${name} PROPERTIES WORKING_DIRECTORY [==[${folder}]==] "
      "FAIL_REGULAR_EXPRESSION [==[\\[  SKIPPED \\]]==]")
    foreach(word IN LISTS properties)
      string(APPEND script " [==[${word}]==]")
    endforeach()
    string(APPEND script ")\n")
  endforeach()
  file(WRITE "${file}" "${script}")
endfunction()
