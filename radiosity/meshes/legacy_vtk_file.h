/// Reads VTK's legacy files (`.vtk`) with poly data or an unstructured grid; text and binary, versions 1 to 5.
/// Source: VTK File Formats (Kitware), section Simple Legacy Formats.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Parses points and cells of `file`, and the cell data of the given names; other data are ignored. Throws InputError
/// for other data sets, cells that are no faces (see vtk_cells.h), cell data that are missing, and malformed files.
PolygonMesh parseLegacyVtk(std::string_view bytes, const std::filesystem::path& file,
                           std::span<const std::string> cellData = {});

}  // namespace hemitex::radiosity
