/// Reads PLY: the positions of vertices and the faces. Text, and binary of both byte orders.
/// Source: G. Turk, The PLY polygon file format, 1994.
#pragma once

#include <filesystem>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Parses the bytes of `file`. All faces are of one group; other elements and properties are skipped. Throws InputError
/// for malformed headers, a file without vertices or faces, indices out of range, and a file that ends too early.
PolygonMesh parsePly(std::string_view bytes, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
