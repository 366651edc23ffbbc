# Opens the page of `hemitex paper`, made of runs that never were, in headless Chromium, without a network: its script
# has to run without a fault, every plot has to show its points and every picture has to be there.
#   cmake -DPROGRAM=hemitex_paper_page -DWORK=folder -DCHROMIUM=chromium -P paper_page_check.cmake
if(NOT CHROMIUM)
  message("skipped: Chromium is not installed")
  return()
endif()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(COMMAND ${PROGRAM} ${WORK} COMMAND_ERROR_IS_FATAL ANY)
file(READ ${WORK}/report.html page)
string(REGEX MATCHALL "(src|href)=[\"']?(https?:)?//[^>]*" resources "${page}")
if(resources)
  message(FATAL_ERROR "the page names resources of a network: ${resources}")
endif()

execute_process(
  COMMAND ${CHROMIUM} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run
    --disable-background-networking --disable-component-update --disable-sync
    "--host-resolver-rules=MAP * ~NOTFOUND" --user-data-dir=${WORK}/profile --dump-dom file://${WORK}/report.html
  OUTPUT_VARIABLE document ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
string(REGEX MATCH "<pre id=\"drawn\"[^>]*>([^<]*)</pre>" found "${document}")
set(drawn "${CMAKE_MATCH_1}")
if(NOT drawn)
  message(FATAL_ERROR "the script of the page did not come to its end")
endif()
string(JSON faults LENGTH ${drawn} faults)
if(faults GREATER 0)
  message(FATAL_ERROR "the script of the page has faults: ${drawn}")
endif()
foreach(plot IN ITEMS time-simple-software time-complex-software)
  string(JSON points GET ${drawn} drawn ${plot} points)
  string(JSON painted GET ${drawn} drawn ${plot} painted)
  if(NOT points EQUAL 12 OR painted LESS 1000)
    message(FATAL_ERROR "plot ${plot} shows ${points} points with ${painted} pixels")
  endif()
endforeach()
string(JSON pictures GET ${drawn} pictures)
if(NOT pictures EQUAL 3)
  message(FATAL_ERROR "the page shows ${pictures} pictures of 3")
endif()
# Of the paper's table of the complex scene, and of the one run that misses what it promises.
foreach(text IN ITEMS "paper: 193 (186)" "paper: lost (294)" "not met")
  string(FIND "${document}" "${text}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "the page does not say `${text}`")
  endif()
endforeach()
