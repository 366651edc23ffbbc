#include "radiosity/meshes/polygon_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hemitex::radiosity {

void addPosition(PolygonMesh& mesh, const glm::dvec3& position, const Place& place) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(position[axis])) fail(place, "a coordinate is not a finite number");
    if (std::fabs(position[axis]) > largestCoordinate)
      fail(place, "a coordinate is above 1e18 in size", "scale the scene down");
  }
  if (!mesh.colours.empty()) mesh.colours.emplace_back(1);
  mesh.positions.push_back(position + 0.0);  // turns -0 into 0, so that equal positions have equal bits
}

void addPolygon(PolygonMesh& mesh, std::span<const std::uint32_t> positions, const Place& place) {
  if (positions.size() < 3) fail(place, "a face has at least 3 corners");
  mesh.polygons.push_back({.firstCorner = static_cast<std::uint32_t>(mesh.corners.size()),
                           .cornerCount = static_cast<std::uint32_t>(positions.size()),
                           .section = static_cast<std::uint32_t>(mesh.sections.size() - 1),
                           .line = place.line});
  for (const std::uint32_t position : positions) {
    if (position >= mesh.positions.size())
      fail(place, "a face names the vertex " + std::to_string(position) + ", counted from 0; there are " +
                      std::to_string(mesh.positions.size()));
    mesh.corners.push_back({position});
  }
}

void addStrip(PolygonMesh& mesh, std::span<const std::uint32_t> positions, const Place& place) {
  for (std::size_t i = 2; i < positions.size(); ++i) {
    const std::uint32_t a = positions[i - 2], b = positions[i - 1 + i % 2], c = positions[i - i % 2];
    if (a != b && b != c && c != a) addPolygon(mesh, std::array{a, b, c}, place);
  }
}

void setColour(PolygonMesh& mesh, const glm::dvec3& linear) {
  mesh.colours.resize(mesh.positions.size(), glm::vec3(1));
  mesh.colours.back() = glm::clamp(linear, 0.0, 1.0);
}

void divideIntoFacets(PolygonMesh& mesh) {
  std::vector<SceneObject> facets;
  std::vector<MeshSection> sections;
  for (MeshPolygon& polygon : mesh.polygons) {
    const MeshSection& section = mesh.sections[polygon.section];
    const std::string number = std::to_string(facets.size());
    polygon.section = static_cast<std::uint32_t>(facets.size());
    sections.push_back({polygon.section, section.material});
    facets.push_back({mesh.objects.size() > 1 ? mesh.objects[section.object].name + "#" + number : number});
  }
  mesh.sections = std::move(sections);
  mesh.objects = std::move(facets);
}

std::string placeOf(const PolygonMesh& mesh, std::uint32_t polygon) {
  const int line = mesh.polygons[polygon].line;
  return line > 0 ? "line " + std::to_string(line) : "face " + std::to_string(polygon + 1);
}

}  // namespace hemitex::radiosity
