/// Writes a mesh with values of its faces as an unstructured grid of VTK (`.vtu`), for ParaView and other programs.
/// Source: VTK File Formats (Kitware), section XML Formats.
#pragma once

#include <filesystem>
#include <span>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// Writes all polygons as cells, in their order, with the arrays as cell data. Each array has one value or vector per
/// polygon. Coordinates and values keep all bits: arrays are appended bytes of double precision, not compressed. Throws
/// InputError if the file cannot be written.
void writeVtu(const std::filesystem::path& file, const PolygonMesh& mesh, std::span<const FaceArray> arrays);

}  // namespace hemitex::radiosity
