/// Reads VTK's XML files with an unstructured grid (`.vtu`) or poly data (`.vtp`).
#pragma once

#include <filesystem>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Parses points and cells of `file`, of all its pieces. Other arrays are ignored. Throws InputError for other kinds of
/// data, cells that are no faces (see vtk_cells.h), other compression than zlib, and malformed files.
PolygonMesh parseVtkXml(std::string_view bytes, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
