# Opens the page of `hemitex tradeoff` in headless Chromium, without a network: its script has to run without a fault,
# and every plot has to show points. A page that is broken on purpose has to be found out.
#   cmake -DPROGRAM=hemitex -DSCENE=scene.obj -DWORK=folder -DCHROMIUM=chromium -P tradeoff_page_check.cmake
if(NOT CHROMIUM)
  message("skipped: Chromium is not installed")
  return()
endif()

file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${PROGRAM} tradeoff ${SCENE} -o ${WORK}/trade --texels 4,2 --patch 2,1 --samples 256
  --method hemicube=32,64 --method centre-rays=64,256 --method area-rays=64,256
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(READ ${WORK}/trade/report.html page)
file(READ ${WORK}/trade/tradeoff.json result)

string(REGEX MATCHALL "(src|href)=[\"']?(https?:)?//[^>]*" resources "${page}")
if(resources)
  message(FATAL_ERROR "the page names resources of a network: ${resources}")
endif()

# What the page says that it has drawn: {"faults": [...], "drawn": {id: {"points": N, "painted": pixels}}}.
function(open_page file result)
  execute_process(
    COMMAND ${CHROMIUM} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run
      --disable-background-networking --disable-component-update --disable-sync
      "--host-resolver-rules=MAP * ~NOTFOUND" --user-data-dir=${file}.profile --dump-dom file://${file}
    OUTPUT_VARIABLE document ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
  string(REGEX MATCH "<pre id=\"drawn\"[^>]*>([^<]*)</pre>" found "${document}")
  set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

open_page(${WORK}/trade/report.html drawn)
if(NOT drawn)
  message(FATAL_ERROR "the script of the page did not come to its end")
endif()
string(JSON faults LENGTH ${drawn} faults)
if(faults GREATER 0)
  message(FATAL_ERROR "the script of the page has faults: ${drawn}")
endif()
foreach(plot IN ITEMS trade rows radiosity memory time points texels patches)
  string(JSON points GET ${drawn} drawn ${plot} points)
  string(JSON painted GET ${drawn} drawn ${plot} painted)
  if(points LESS 4 OR painted LESS 1000)
    message(FATAL_ERROR "plot ${plot} shows ${points} points with ${painted} pixels")
  endif()
endforeach()
string(JSON choices LENGTH ${result} choices)
string(JSON points GET ${drawn} drawn trade points)
if(points LESS choices)
  message(FATAL_ERROR "${choices} choices were measured, and ${points} points are shown")
endif()

# Neither a fault nor an empty plot would go unnoticed.
string(REPLACE "new Chart(canvas" "new NoChart(canvas" broken "${page}")
file(WRITE ${WORK}/broken.html "${broken}")
open_page(${WORK}/broken.html drawn)
if(drawn)
  message(FATAL_ERROR "a page without charts passes for one with charts: ${drawn}")
endif()
