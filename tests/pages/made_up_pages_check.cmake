# Opens the pages of `hemitex paper` and `hemitex bench`, made of made-up measurements, in headless Chromium, without a
# network: their scripts have to run without a fault, every plot has to show its points and every picture has to be there.
#   cmake -DPROGRAM=hemitex_made_up_pages -DWORK=folder -DCHROMIUM=chromium -P made_up_pages_check.cmake
if(NOT CHROMIUM)
  message("skipped: Chromium is not installed")
  return()
endif()
include(${CMAKE_CURRENT_LIST_DIR}/page_check.cmake)

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(COMMAND ${PROGRAM} ${WORK} COMMAND_ERROR_IS_FATAL ANY)

# Opens a page. Its plots show the numbers of points that follow as PLOT=POINTS.
macro(check_page file)
  file(READ ${WORK}/${file} page)
  require_no_network("${page}")
  open_page(${WORK}/${file} document)
  told_in("${document}" told)
  require_no_faults("${told}")
  foreach(entry IN ITEMS ${ARGN})
    string(REPLACE "=" ";" entry ${entry})
    list(POP_FRONT entry plot expected)
    points_of(${plot} "${told}" points)
    if(NOT points EQUAL ${expected})
      message(FATAL_ERROR "plot ${plot} of ${file} shows ${points} points of ${expected}")
    endif()
  endforeach()
endmacro()

macro(require_text text)
  string(FIND "${document}" "${text}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "the page does not say `${text}`")
  endif()
endmacro()

# Times, and below them ratios.
check_page(bench.html times-room=10)
foreach(text IN ITEMS "6.25<small>2.5</small>" "1,000")
  require_text("${text}")
endforeach()

check_page(paper.html time-simple-software=12 time-complex-software=12)
string(JSON pictures GET ${told} pictures)
if(NOT pictures EQUAL 3)
  message(FATAL_ERROR "the page shows ${pictures} pictures of 3")
endif()
# Of the paper's table of the complex scene.
foreach(text IN ITEMS "paper: 193 (186)" "paper: lost (294)")
  require_text("${text}")
endforeach()
