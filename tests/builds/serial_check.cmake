# cmake -DSOURCE=<hemitex> -DWORK=<scratch folder> -DCOMPILER=<c++> -P serial_check.cmake
# Builds the rasterizer without oneTBB and runs its tests.
foreach(step
    "-S;${SOURCE};-B;${WORK};--preset;release;-DHEMITEX_THREADS=OFF;-DCMAKE_CXX_COMPILER=${COMPILER}"
    "--build;${WORK};--target;hemitex_raster_tests;--parallel")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${WORK}/bin/hemitex_raster_tests COMMAND_ERROR_IS_FATAL ANY)
