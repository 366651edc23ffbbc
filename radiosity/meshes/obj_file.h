/// Parses an OBJ file: positions, texture coordinates and polygons.
///
/// Numbers (`v`, `vt`, `vn` and the indices of `f`) are parsed here as doubles and checked. tinyobjloader does not read
/// OBJ files here, because it rounds numbers, reads `x` and `nan` as 0 and accepts indices out of range. It parses the
/// options of maps in MTL files (mtl_file.h).
#pragma once

#include <filesystem>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Reads a file. Throws InputError if it cannot be read, and as parseObj.
PolygonMesh readObj(const std::filesystem::path& file);

/// Parses the text of `file`. Throws InputError with the line for a malformed or non-finite number, an absolute
/// coordinate above 1e18, and a vertex with too few numbers. Also throws it for an index that is malformed or out of
/// range, and a face with fewer than three corners. A normal out of range is a warning.
PolygonMesh parseObj(std::string_view text, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
