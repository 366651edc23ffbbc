# Checks each page that the program writes in headless Chromium. The script of the page reports:
# {"faults": [...], "drawn": {id: {"points": N, "painted": pixels}}, "pictures": N}.

# Pages must work without a network: they must not refer to other files.
function(require_no_network page)
  string(REGEX MATCHALL "(src|href)=[\"']?(https?:)?//[^>]*" resources "${page}")
  if(resources)
    message(FATAL_ERROR "the page names resources of a network: ${resources}")
  endif()
endfunction()

# The document after the scripts of a file have run, without a network.
function(open_page file document)
  execute_process(
    COMMAND ${CHROMIUM} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run
      --disable-background-networking --disable-component-update --disable-sync
      "--host-resolver-rules=MAP * ~NOTFOUND" --user-data-dir=${file}.profile --dump-dom file://${file}
    OUTPUT_VARIABLE opened ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
  set(${document} "${opened}" PARENT_SCOPE)
endfunction()

# The report of a document's script; empty if the script did not reach its end.
function(told_in document told)
  string(REGEX MATCH "<pre id=\"drawn\"[^>]*>([^<]*)</pre>" found "${document}")
  set(${told} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

function(require_no_faults told)
  if(NOT told)
    message(FATAL_ERROR "the script of the page did not come to its end")
  endif()
  string(JSON faults LENGTH ${told} faults)
  if(faults GREATER 0)
    message(FATAL_ERROR "the script of the page has faults: ${told}")
  endif()
endfunction()

# The number of points of a plot, which must also be painted.
function(points_of plot told points)
  string(JSON shown GET ${told} drawn ${plot} points)
  string(JSON painted GET ${told} drawn ${plot} painted)
  if(painted LESS 1000)
    message(FATAL_ERROR "plot ${plot} shows ${shown} points with ${painted} pixels")
  endif()
  set(${points} ${shown} PARENT_SCOPE)
endfunction()
