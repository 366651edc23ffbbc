/// Reads STL, text and binary. All vertices are of their triangles alone.
/// Source: M. Burns, Automated Fabrication, 1993, section 6.5.
#pragma once

#include <filesystem>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Parses the bytes of `file`. They are a text if the first word is `solid` or `facet` and no NUL byte follows soon,
/// else binary. Each `solid` of a text is a group. The order of vertices says which side is the front; a normal that
/// contradicts it is a warning, and one that is no number says nothing. Warns of colours of facets and of bytes behind
/// the last triangle, which are left out. Throws InputError, with the line of a text, for anything else.
PolygonMesh parseStl(std::string_view bytes, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
