# cmake -DSOURCE=<hemitex> -DWORK=<scratch folder> -DCOMPILER=<c++> -DLAUNCHER=<ccache or nothing> -P check.cmake
# Builds the project beside this file, which contains hemitex, runs its tests and installs it.
file(REMOVE_RECURSE ${WORK})
foreach(step
    "-S;${CMAKE_CURRENT_LIST_DIR};-B;${WORK}/build;-G;Ninja;-DHEMITEX=${SOURCE};-DHEMITEX_SOLVER=OFF;\
-DCMAKE_BUILD_TYPE=Release;-DCMAKE_CXX_FLAGS_RELEASE=-O2;-DCMAKE_CXX_COMPILER=${COMPILER};\
-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
    "--build;${WORK}/build;--target;parent"
    "--install;${WORK}/build;--prefix;${WORK}/prefix")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build OUTPUT_VARIABLE tests COMMAND_ERROR_IS_FATAL ANY)
if(NOT tests MATCHES "100% tests passed, 0 tests failed out of 1\n")
  message(FATAL_ERROR "the parent has one test, but ctest says: ${tests}")
endif()

function(expect_files folder expected)
  file(GLOB_RECURSE found RELATIVE ${folder} ${folder}/*)
  if(NOT found STREQUAL expected)
    message(FATAL_ERROR "${folder} holds ${found}, expected ${expected}")
  endif()
endfunction()
expect_files(${WORK}/build/programs parent)
expect_files(${WORK}/prefix bin/parent)
foreach(folder IN ITEMS bin lib share)
  if(EXISTS ${WORK}/build/${folder})
    message(FATAL_ERROR "hemitex writes into the folder ${folder} of its parent")
  endif()
endforeach()
