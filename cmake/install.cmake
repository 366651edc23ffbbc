# Installs the headers and what find_package(hemitex) reads. Libraries and the program are installed where they are built.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hemitex)

set(folders raster reference)
if(HEMITEX_SOLVER)
  list(APPEND folders radiosity)
endif()
install(DIRECTORY ${folders} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hemitex FILES_MATCHING PATTERN "*.h")

get_property(built GLOBAL PROPERTY HEMITEX_COMPONENTS)
get_property(requirements GLOBAL PROPERTY HEMITEX_REQUIREMENTS)
configure_package_config_file(cmake/hemitexConfig.cmake.in hemitexConfig.cmake INSTALL_DESTINATION ${package_folder}
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(hemitexConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hemitexConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/hemitexConfigVersion.cmake
  cmake/Findlibmd.cmake cmake/Findlibzip.cmake cmake/Findepoxy.cmake DESTINATION ${package_folder})
