# cmake -DSOURCE=<hemitex> -DWORK=<scratch folder> -DCOMPILER=<c++> -DLAUNCHER=<ccache or nothing> -P check.cmake
# Configures the project beside this file, which contains hemitex. Then builds it with FetchContent and without the
# solver, runs and installs it.
file(REMOVE_RECURSE ${WORK})
set(options -G Ninja -DHEMITEX=${SOURCE} -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELEASE=-O2
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
set(fetched OFF ON)
set(folders hemitex _deps/hemitex-build)

# All of hemitex adds no test and writes into its own folder, whichever way it comes into the project.
foreach(fetch folder IN ZIP_LISTS fetched folders)
  set(build ${WORK}/all-${fetch})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${build} ${options} -DFETCH=${fetch}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${build} --show-only OUTPUT_VARIABLE tests
    COMMAND_ERROR_IS_FATAL ANY)
  if(NOT tests MATCHES "Total Tests: 1\n")
    message(FATAL_ERROR "the parent has one test, but ctest says: ${tests}")
  endif()
  if(EXISTS ${build}/share OR NOT EXISTS ${build}/${folder}/share)
    message(FATAL_ERROR "the scenes of hemitex belong into its own folder share")
  endif()
endforeach()

foreach(step
    "-S;${CMAKE_CURRENT_LIST_DIR};-B;${WORK}/build;${options};-DFETCH=ON;-DHEMITEX_SOLVER=OFF"
    "--build;${WORK}/build;--target;parent"
    "--install;${WORK}/build;--prefix;${WORK}/prefix")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${WORK}/build/programs/parent COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE installed RELATIVE ${WORK}/prefix ${WORK}/prefix/*)
if(NOT installed STREQUAL "bin/parent")
  message(FATAL_ERROR "the parent installs bin/parent, but there is ${installed}")
endif()
