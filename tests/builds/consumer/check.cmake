# cmake -DBUILD=<built hemitex> -DWORK=<scratch folder> -DCOMPILER=<c++> -P check.cmake
# Installs hemitex into an empty prefix, builds the consumer against it and runs it.
file(REMOVE_RECURSE ${WORK})
foreach(step
    "--install;${BUILD};--prefix;${WORK}/prefix"
    "-S;${CMAKE_CURRENT_LIST_DIR};-B;${WORK}/build;-DCMAKE_PREFIX_PATH=${WORK}/prefix;-DCMAKE_CXX_COMPILER=${COMPILER}"
    "--build;${WORK}/build")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${WORK}/build/consumer COMMAND_ERROR_IS_FATAL ANY)
# Completion scripts and manual pages are where shells and man look for them.
foreach(file bash-completion/completions/hemitex zsh/site-functions/_hemitex fish/vendor_completions.d/hemitex.fish
    man/man1/hemitex.1 man/man1/hemitex-vector-check.1)
  if(NOT EXISTS ${WORK}/prefix/share/${file})
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()
# The scenes of the vector suite are installed with the program.
execute_process(COMMAND ${WORK}/prefix/bin/hemitex --quiet vector suite -o ${WORK}/suite
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
# The installed program finds its module for images.
execute_process(COMMAND ${WORK}/prefix/bin/hemitex --quiet render ${WORK}/prefix/share/hemitex/pyramid-room.obj --show ids
  --size 64x48 -o ${WORK}/ids.png OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
