/// Reads the geometry of View3D (`.vs3`) in the format `3`: vertices and surfaces with 3 or 4 of them.
/// Source: View3D 3.3 (NIST), doc/view3d-manual.tex and src/getdat.c.
#pragma once

#include <filesystem>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Parses the text of `file`. Each surface and each obstruction is a face; its group is the surface's name. The
/// mesh has the array `reflectance`: 1 less the emittance of a surface, and 0 for obstructions. View3D adds up surfaces
/// that it combines; here they stay faces of their own, with a warning. Throws InputError with the line for other
/// formats, masks, surfaces inside of others, numbers out of sequence and indices out of range.
PolygonMesh parseVs3(std::string_view text, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
