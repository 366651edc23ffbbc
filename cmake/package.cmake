# `cpack -G DEB` in the build folder writes one Debian package of all that is installed.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hemitex RENAME copyright)
foreach(folder IN ITEMS docs data)  # the pages name scenes and their own files as in the sources
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hemitex
    PATTERN generate EXCLUDE PATTERN "*.truth.csv" EXCLUDE PATTERN CMakeLists.txt EXCLUDE)
endforeach()
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hemitex)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hemitex)
set(CPACK_PACKAGE_CONTACT "hemitex maintainers <hemitex@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "light of 3D scenes by radiosity, and test vectors for its rasterizer")
set(CPACK_PACKAGE_DESCRIPTION "hemitex reads an OBJ or glTF file and writes the same scene with its light in textures.
It has the program, the libraries with their headers, scenes, a tutorial and exercises.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What programs that link the libraries are built with.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, libglm-dev, libtbb-dev, libhwy-dev, libembree-dev, libpugixml-dev, zlib1g-dev, libzip-dev, libmd-dev, libepoxy-dev")
include(CPack)
