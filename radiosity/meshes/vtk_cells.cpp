#include "radiosity/meshes/vtk_cells.h"

#include <array>

namespace hemitex::radiosity {

void addVtkCell(PolygonMesh& mesh, std::uint32_t type, std::span<const std::uint32_t> points, const Place& place,
                std::uint32_t& leftOut) {
  enum : std::uint32_t { Vertex = 1, PolyLine = 4, Pixel = 8, Quad = 9, Wedge = 13, Pyramid = 14, Tetra = 10 };
  if (type <= PolyLine) {
    ++leftOut;
    return;
  }
  if (type == vtkStrip) return addStrip(mesh, points, place);
  if (type >= Tetra && type <= Pyramid + 2)
    fail(place, "has volume cells (type " + std::to_string(type) + ")",
         "extract the surface, in ParaView with Extract Surface");
  if (type > Quad)
    fail(place, "has cells of the type " + std::to_string(type), "convert them to triangles or polygons");
  const std::size_t wanted = type == vtkTriangle ? 3 : type == vtkPolygon ? points.size() : 4;
  if (points.size() != wanted)
    fail(place, "a cell of type " + std::to_string(type) + " has " + std::to_string(points.size()) + " points");
  if (type == Pixel) return addPolygon(mesh, std::array{points[0], points[1], points[3], points[2]}, place);
  addPolygon(mesh, points, place);
}

void addCellValues(FaceArray& array, int components, std::span<const double> values,
                   std::span<const std::uint32_t> faces, const Place& place) {
  if (components != 1 && components != 3)
    fail(place, "the cell data `" + array.name + "` have " + std::to_string(components) + " components",
         "give one component, or three for red, green and blue");
  if (!array.values.empty() && array.components != components)
    fail(place, "pieces of the cell data `" + array.name + "` have different numbers of components");
  array.components = components;
  const auto count = static_cast<std::size_t>(components);
  for (const std::uint32_t cell : faces) {
    const std::span<const double> ofCell = values.subspan(cell * count, count);
    array.values.insert(array.values.end(), ofCell.begin(), ofCell.end());
  }
}

void finishVtkMesh(PolygonMesh& mesh, std::uint32_t leftOut, const std::filesystem::path& file) {
  if (leftOut > 0)
    mesh.warnings.push_back(std::to_string(leftOut) +
                            " cells that are points or lines are left out; faces are numbered without them");
  if (mesh.polygons.empty()) fail({file}, "has no face", "give a mesh with triangles or polygons");
}

}  // namespace hemitex::radiosity
