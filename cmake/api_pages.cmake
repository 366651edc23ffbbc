# Target api_pages: Doxygen writes a page per folder, header and type of the libraries into api/ of the build folder.
# The comments of the headers are the source, and README.md of each folder is the first page of the folder. Any warning
# is an error: a name that does not exist, a wrong parameter, broken markup. A declaration needs no comment if its name
# says all, so that missing comments are no warning.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()

set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/api)
set(DOXYGEN_HTML_OUTPUT .)
set(DOXYGEN_PROJECT_BRIEF "Radiosity with item buffers")
set(DOXYGEN_FILE_PATTERNS *.h *.dox README.md)
set(DOXYGEN_EXTENSION_MAPPING md=C++)
set(DOXYGEN_INPUT_FILTER "sed -f ${PROJECT_SOURCE_DIR}/cmake/api_comments.sed")
set(DOXYGEN_LAYOUT_FILE ${PROJECT_SOURCE_DIR}/cmake/api_layout.xml)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_EXTRACT_LOCAL_CLASSES NO)
set(DOXYGEN_GENERATE_TREEVIEW YES)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR})
doxygen_add_docs(api_pages cmake/api_main_page.dox raster radiosity reference
  COMMENT "Writing the pages of the API into api/")
if(HEMITEX_TESTS)
  enable_testing()
  add_test(NAME "The comments of the libraries give API pages without a warning"
    COMMAND Doxygen::doxygen ${CMAKE_CURRENT_BINARY_DIR}/Doxyfile.api_pages WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endif()
