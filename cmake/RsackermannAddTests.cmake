# Tests that are programs of opencv_ts, and write their results to RSACKERMANN_TEST_RESULTS_DIR.

# Adds a test that runs a program of opencv_ts with the arguments given.
function(rsackermann_add_gtest name program)
  add_test(NAME ${name}
    COMMAND ${program} "--gtest_output=xml:${RSACKERMANN_TEST_RESULTS_DIR}/${name}.xml" ${ARGN})
endfunction()

# Adds the tests NAME_1, NAME_2 and so on, which share the cases of the program between them, so that they can run beside
# each other.
function(rsackermann_add_sharded_test name program shards)
  foreach(number RANGE 1 ${shards})
    math(EXPR index "${number} - 1")
    rsackermann_add_gtest(${name}_${number} ${program} ${ARGN})
    set_tests_properties(${name}_${number} PROPERTIES
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()
