#include "radiosity/scene/mesh_sections.h"

#include <map>
#include <span>

#include "radiosity/geometry/triangulation.h"

namespace hemitex::radiosity {
namespace {

Triangle makeTriangle(const PolygonMesh& mesh, std::uint32_t polygonIndex,
                      const std::array<std::uint32_t, 3>& corners) {
  constexpr std::array<glm::dvec2, 4> quad{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)};
  const MeshPolygon& polygon = mesh.polygons[polygonIndex];
  Triangle triangle;
  triangle.polygon = polygonIndex;
  std::array<glm::dvec3, 3> colors{};
  bool colored = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshCorner& corner = mesh.corners[polygon.firstCorner + corners[k]];
    triangle.position[k] = mesh.positions[corner.position];
    if (polygon.textured) triangle.texcoord[k] = mesh.texcoords[*corner.texcoord];
    if (polygon.cornerCount == 4) triangle.chart[k] = quad[corners[k]];
    const std::optional<glm::dvec3>& color = mesh.colors[corner.position];
    colored = colored && color.has_value();
    colors[k] = color.value_or(glm::dvec3(0.0));
  }
  if (colored) triangle.cornerColor = colors;
  return triangle;
}

/// Counts faces with a fault, for a warning that names the first.
struct FaceCount {
  int count = 0;
  std::string first = {};  ///< its place

  void add(const PolygonMesh& mesh, std::uint32_t polygon) {
    if (count++ == 0) first = placeOf(mesh, polygon);
  }
  void warn(std::vector<std::string>& warnings, const std::string& what) const {
    if (count == 0) return;
    const std::string faces = count == 1 ? "1 face " : std::to_string(count) + " faces ";
    warnings.push_back(faces + what + " (" + first + (count == 1 ? ")" : " first)"));
  }
};

std::vector<glm::dvec3> positionsOf(const PolygonMesh& mesh, const MeshPolygon& polygon) {
  std::vector<glm::dvec3> positions;
  for (const MeshCorner& corner : std::span(mesh.corners).subspan(polygon.firstCorner, polygon.cornerCount)) {
    positions.push_back(mesh.positions[corner.position]);
  }
  return positions;
}

/// Makes room for the triangles of all polygons, so that the lists are not copied as they grow.
void reserveTriangles(const PolygonMesh& mesh, std::vector<Section>& sections) {
  std::vector<std::size_t> counts(sections.size());
  for (const MeshPolygon& polygon : mesh.polygons) counts[polygon.section] += polygon.cornerCount - 2;
  for (std::size_t s = 0; s < sections.size(); ++s) sections[s].triangles.reserve(counts[s]);
}

/// One section per section of the file; some may be empty.
std::vector<Section> cutPolygons(const PolygonMesh& mesh, std::vector<std::string>& warnings) {
  std::vector<Section> sections(mesh.sections.size());
  reserveTriangles(mesh, sections);
  FaceCount degenerate, crossing;
  for (std::uint32_t p = 0; p < mesh.polygons.size(); ++p) {
    const MeshPolygon& polygon = mesh.polygons[p];
    const std::vector<glm::dvec3> positions = positionsOf(mesh, polygon);
    const Triangulation cut = triangulate(positions);
    std::vector<Triangle>& triangles = sections[polygon.section].triangles;
    const std::size_t before = triangles.size();
    for (const std::array<std::uint32_t, 3>& t : cut.triangles) {
      if (hasArea(positions[t[0]], positions[t[1]], positions[t[2]])) triangles.push_back(makeTriangle(mesh, p, t));
    }
    const bool isDegenerate = triangles.size() == before;
    if (isDegenerate) degenerate.add(mesh, p);
    if (cut.crossing && !isDegenerate) crossing.add(mesh, p);
  }
  degenerate.warn(warnings, "without area dropped");
  crossing.warn(warnings, "that cross themselves triangulated as well as can be");
  return sections;
}

}  // namespace

std::vector<Section> cutIntoSections(const PolygonMesh& mesh, std::vector<std::string>& warnings) {
  std::vector<Section> sections = cutPolygons(mesh, warnings);
  std::map<std::string, int> sectionsOfGroup;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (!sections[s].triangles.empty()) ++sectionsOfGroup[mesh.sections[s].group];
  }
  std::set<std::string> taken;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (sections[s].triangles.empty()) continue;
    const auto& [group, material] = mesh.sections[s];
    const std::string suffix = "/" + (material.empty() ? "default" : material);
    sections[s].family = uniqueName(taken, sectionsOfGroup[group] > 1 ? group + suffix : group);
    sections[s].material = material;
  }
  std::erase_if(sections, [](const Section& section) { return section.triangles.empty(); });
  return sections;
}

std::string uniqueName(std::set<std::string>& taken, const std::string& wanted) {
  std::string name = wanted;
  for (int n = 2; !taken.insert(name).second; ++n) name = wanted + "~" + std::to_string(n);
  return name;
}

}  // namespace hemitex::radiosity
