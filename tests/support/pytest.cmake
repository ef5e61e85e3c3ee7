# Tests of the program as a whole are written in Python; ctest runs each file of them as one test.
# Debian's own Python first, because Debian's packages put their modules there.
find_program(VELDT_TEST_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(VELDT_TEST_PYTHON python3 REQUIRED)

# veldt_pytest(NAME name LABEL label FILE test_….py [WHICH part of names] TIMEOUT seconds)
function(veldt_pytest)
  cmake_parse_arguments(TEST "" "NAME;LABEL;FILE;WHICH;TIMEOUT" "" ${ARGN})
  if(TEST_WHICH)
    set(which -k "${TEST_WHICH}")
  endif()
  add_test(NAME ${TEST_NAME}
           COMMAND ${VELDT_TEST_LAUNCHER} ${VELDT_TEST_PYTHON} -B -m pytest -q ${CMAKE_CURRENT_SOURCE_DIR}/${TEST_FILE}
                   ${which}
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${TEST_NAME} PROPERTIES LABELS ${TEST_LABEL} TIMEOUT ${TEST_TIMEOUT} ENVIRONMENT
                                               "VELDT_PROGRAM=$<TARGET_FILE:veldt>")
endfunction()
