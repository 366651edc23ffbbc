# Opens the page of `hemitex tradeoff` in headless Chromium without a network. Its script must run without a fault, and
# all plots must show points. A page with an injected fault must fail.
#   cmake -DPROGRAM=hemitex -DSCENE=scene.obj -DWORK=folder -DCHROMIUM=chromium -P tradeoff_page_check.cmake
if(NOT CHROMIUM)
  message("skipped: Chromium is not installed")
  return()
endif()
include(${CMAKE_CURRENT_LIST_DIR}/page_check.cmake)

file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${PROGRAM} tradeoff ${SCENE} -o ${WORK}/trade --texels 4,2 --patch 2,1 --samples 256
  --method hemicube=32,64 --method centre-rays=64,256 --method area-rays=64,256
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(READ ${WORK}/trade/report.html page)
file(READ ${WORK}/trade/tradeoff.json result)
require_no_network("${page}")

open_page(${WORK}/trade/report.html document)
told_in("${document}" told)
require_no_faults("${told}")
foreach(plot IN ITEMS trade rows radiosity memory time points texels patches)
  points_of(${plot} "${told}" points)
  if(points LESS 4)
    message(FATAL_ERROR "plot ${plot} shows ${points} points")
  endif()
endforeach()
string(JSON choices LENGTH ${result} choices)
points_of(trade "${told}" points)
if(points LESS choices)
  message(FATAL_ERROR "${choices} choices were measured, and ${points} points are shown")
endif()

# The check must detect a fault and an empty plot.
string(REPLACE "new Chart(canvas" "new NoChart(canvas" broken "${page}")
file(WRITE ${WORK}/broken.html "${broken}")
open_page(${WORK}/broken.html document)
told_in("${document}" told)
if(told)
  message(FATAL_ERROR "a page without charts passes for one with charts: ${told}")
endif()
