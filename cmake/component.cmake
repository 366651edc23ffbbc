# hemitex_component(NAME [NEEDS COMPONENT...] [PACKAGES PACKAGE...])
# Makes the library hemitex_NAME a component: hemitex::NAME in this build and after find_package(hemitex COMPONENTS NAME).
# NEEDS names the components that it links, and PACKAGES what find_package must find for programs that link it, with a
# version where one is needed: "embree 3".
# Components are declared after those that they need.
function(hemitex_component name)
  cmake_parse_arguments(PARSE_ARGV 1 component "" "" "NEEDS;PACKAGES")
  add_library(hemitex::${name} ALIAS hemitex_${name})
  set_target_properties(hemitex_${name} PROPERTIES EXPORT_NAME ${name})
  if(NOT HEMITEX_INSTALL)
    return()
  endif()
  install(TARGETS hemitex_${name} EXPORT hemitex_${name})
  install(EXPORT hemitex_${name} FILE hemitex-${name}.cmake NAMESPACE hemitex::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hemitex)
  set_property(GLOBAL APPEND PROPERTY HEMITEX_COMPONENTS ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY HEMITEX_REQUIREMENTS
    "set(hemitex_${name}_needs \"${component_NEEDS}\")\nset(hemitex_${name}_packages \"${component_PACKAGES}\")\n")
endfunction()
