# Tests of the program as a whole are written in Python.
# Debian's own Python first, because Debian's packages put their modules there.
find_program(VELDT_TEST_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(VELDT_TEST_PYTHON python3 REQUIRED)
cmake_host_system_information(RESULT VELDT_CORES QUERY NUMBER_OF_LOGICAL_CORES)

# veldt_pytest(NAME name LABELS kind cost FILES test_….py … [WHICH part of names] [SKIP reason] [SERIAL])
# One run of pytest over all files, on all cores; with SERIAL on one, beside other tests. Its own times are in
# Testing/<name>.xml. Whoever skips says why, and only those with a reason in SKIP may.
function(veldt_pytest)
  cmake_parse_arguments(TEST "SERIAL" "NAME;WHICH;SKIP" "LABELS;FILES" ${ARGN})
  if(TEST_WHICH)
    set(which -k "${TEST_WHICH}")
  endif()
  if(NOT TEST_SERIAL)
    set(on_all_cores --numprocesses ${VELDT_CORES} --dist loadfile)
  endif()
  list(TRANSFORM TEST_FILES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  add_test(NAME ${TEST_NAME}
           COMMAND ${VELDT_TEST_LAUNCHER} ${VELDT_TEST_PYTHON} -B -m pytest -q ${on_all_cores}
                   --junitxml ${CMAKE_BINARY_DIR}/Testing/${TEST_NAME}.xml ${which} ${TEST_FILES}
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${TEST_NAME} PROPERTIES LABELS "${TEST_LABELS};pytest" TIMEOUT ${VELDT_PATIENCE_S}
                                               ENVIRONMENT "VELDT_PROGRAM=$<TARGET_FILE:veldt>")
  if(NOT TEST_SERIAL)
    set_tests_properties(${TEST_NAME} PROPERTIES PROCESSORS ${VELDT_CORES})
  endif()
  # pytest passes a run in which all tests were skipped; ctest must not.
  if(TEST_SKIP)
    set_tests_properties(${TEST_NAME} PROPERTIES SKIP_REGULAR_EXPRESSION "${TEST_SKIP}")
  endif()
endfunction()
