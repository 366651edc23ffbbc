# cmake -DBUILD=<built hemitex> -DWORK=<scratch folder> -DCOMPILER=<c++> -P check.cmake
# Installs hemitex, moves the installed folder, builds the project beside this file against it and runs it.
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${WORK}/first ${WORK}/moved)

# The files of the components name no folder of this machine.
file(GLOB_RECURSE exports ${WORK}/moved/hemitex-*.cmake)
if(NOT exports)
  message(FATAL_ERROR "no file of a component is installed")
endif()
foreach(export IN LISTS exports)
  file(STRINGS ${export} folders REGEX "/usr/|${BUILD}|${WORK}")
  if(folders)
    message(FATAL_ERROR "${export} names folders of this machine: ${folders}")
  endif()
endforeach()

# Nor does the program look for its module in the folder of the build.
file(STRINGS ${WORK}/moved/bin/hemitex folders REGEX "${BUILD}/lib")
if(folders)
  message(FATAL_ERROR "the installed program names ${folders}")
endif()

foreach(step
    "-S;${CMAKE_CURRENT_LIST_DIR};-B;${WORK}/build;-DCMAKE_PREFIX_PATH=${WORK}/moved;-DCMAKE_CXX_COMPILER=${COMPILER}"
    "--build;${WORK}/build")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${WORK}/build/components COMMAND_ERROR_IS_FATAL ANY)
