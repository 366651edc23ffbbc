/// Reads VTK's legacy files (`.vtk`) with poly data or an unstructured grid; text and binary, versions 1 to 5.
/// Source: VTK File Formats (Kitware), section Simple Legacy Formats.
#pragma once

#include <filesystem>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Parses points and cells of `file`; data of points and cells are ignored. Throws InputError for other data sets,
/// cells that are no faces (see vtk_cells.h), and malformed files.
PolygonMesh parseLegacyVtk(std::string_view bytes, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
