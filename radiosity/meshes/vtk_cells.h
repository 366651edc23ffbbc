/// The cells of VTK's files that are faces.
/// Source: VTK File Formats, and the list of cell types of VTK 9.
#pragma once

#include <cstdint>
#include <span>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// The types of a triangle, of a strip of them, and of a polygon, which those in poly data have.
inline constexpr std::uint8_t vtkTriangle = 5, vtkStrip = 6, vtkPolygon = 7;

/// Appends a cell of a type with its points. Vertices and lines are not faces: they are left out and counted. Throws
/// InputError at `place` for volumes, curved cells, and cells with a wrong number of points.
void addVtkCell(PolygonMesh& mesh, std::uint32_t type, std::span<const std::uint32_t> points, const Place& place,
                std::uint32_t& leftOut);

/// Appends the values of the cells that became faces to an array, of which earlier cells may have values. `values` has
/// `components` per cell. Throws InputError at `place` unless these are 1 or 3, and as many as before.
void addCellValues(FaceArray& array, int components, std::span<const double> values,
                   std::span<const std::uint32_t> faces, const Place& place);

/// Warns of cells that were left out. Throws InputError if the mesh has no face.
void finishVtkMesh(PolygonMesh& mesh, std::uint32_t leftOut, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
