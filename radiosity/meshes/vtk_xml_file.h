/// Reads VTK's XML files with an unstructured grid (`.vtu`) or poly data (`.vtp`).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Parses points and cells of `file`, of all its pieces, and the cell data of the given names. Other arrays are
/// ignored. Throws InputError for other kinds of data, cells that are no faces (see vtk_cells.h), other compression
/// than zlib, cell data that are missing, and malformed files.
PolygonMesh parseVtkXml(std::string_view bytes, const std::filesystem::path& file,
                        std::span<const std::string> cellData = {});

}  // namespace hemitex::radiosity
