# cmake -DBUILD=<built hemitex> -DWORK=<scratch folder> -DCOMPILER=<c++> [-DCATCH2=<prefix of Catch2>] -P check.cmake
# Installs hemitex, builds the project beside this file against it, and runs its tests: those of the right backend pass,
# and those of the wrong one fail with the name of its fault.
file(REMOVE_RECURSE ${WORK})
foreach(step
    "--install;${BUILD};--prefix;${WORK}/prefix"
    "-S;${CMAKE_CURRENT_LIST_DIR};-B;${WORK}/build;-DCMAKE_PREFIX_PATH=${WORK}/prefix\\;${CATCH2};-DCMAKE_CXX_COMPILER=${COMPILER}"
    "--build;${WORK}/build")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# expect(RESULT TEXT [VARIABLE=VALUE...] -- ARGUMENT...): the tests end with RESULT, 0 or FAILURE, and print the TEXT.
function(expect result text)
  cmake_parse_arguments(PARSE_ARGV 2 with "" "" "--")
  execute_process(COMMAND ${CMAKE_COMMAND} -E env ${with_UNPARSED_ARGUMENTS} ${WORK}/build/catch2_suite ${with_--}
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  string(REGEX REPLACE "[ \n]+" " " output "${output}${errors}")  # Catch2 breaks lines
  if(NOT code EQUAL 0)
    set(code FAILURE)
  endif()
  if(NOT code STREQUAL result OR NOT output MATCHES "${text}")
    message(FATAL_ERROR "${with_--} with ${with_UNPARSED_ARGUMENTS} ends with ${code} and prints: ${output}")
  endif()
endfunction()

expect(0 "All tests passed" -- "right: *")
expect(FAILURE "test cases: [0-9]+ \\| [0-9]+ failed" -- "wrong: *")  # none passed
expect(FAILURE "diagnosis: picture upside down \\(.* pixel [0-9]+,[0-9]+ of top holds .*: draw .* weights \\(b = edge"
  -- "wrong: five-faces")
expect(0 "1 test case" -- "right: five-faces")

# What is expected may fail, and a wrong line is an error.
file(WRITE ${WORK}/known.txt "five-faces fail the rows are reversed\n")
expect(0 "failed as expected" EXPECTATIONS=${WORK}/known.txt -- "wrong: five-faces")
file(WRITE ${WORK}/known.txt "six-faces fail no such vector\n")
expect(FAILURE "the suite has no vector \"six-faces\"" EXPECTATIONS=${WORK}/known.txt -- "right: five-faces")

# A section per profile, and vectors of a folder.
file(WRITE ${WORK}/coarse.json "{\"subpixel_bits\": 4}")
expect(0 "2 assertions in 1 test case" PROFILE=${WORK}/coarse.json -- "right: five-faces")
expect(0 "1 assertion in 1 test case" PROFILE=${WORK}/coarse.json -- "right: five-faces" -c "profile coarse")
execute_process(COMMAND ${WORK}/prefix/bin/hemitex --quiet vector random --seed 3 --count 23 -o ${WORK}/random
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
expect(0 "23 assertions in 23 test cases" SUITE=${WORK}/random -- "right: *")
expect(0 "1 assertion in 1 test case" SUITE=${WORK}/random -- "right: *[slivers]")

# CTest has a test per vector.
execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build -R "right: (five-faces|needles)$"
  OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
if(NOT output MATCHES "100% tests passed, 0 tests failed out of 2")
  message(FATAL_ERROR "CTest runs not two tests: ${output}")
endif()
