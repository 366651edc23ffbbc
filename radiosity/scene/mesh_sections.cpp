#include "radiosity/scene/mesh_sections.h"

#include <map>
#include <span>

#include "radiosity/geometry/triangulation.h"

namespace hemitex::radiosity {
namespace {

Triangle makeTriangle(const ObjFile& obj, std::uint32_t polygonIndex, const std::array<std::uint32_t, 3>& corners) {
  constexpr std::array<glm::dvec2, 4> quad{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)};
  const ObjPolygon& polygon = obj.polygons[polygonIndex];
  Triangle triangle;
  triangle.polygon = polygonIndex;
  std::array<glm::dvec3, 3> colors{};
  bool colored = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const ObjCorner& corner = obj.corners[polygon.firstCorner + corners[k]];
    triangle.position[k] = obj.positions[corner.position];
    if (polygon.textured) triangle.texcoord[k] = obj.texcoords[*corner.texcoord];
    if (polygon.cornerCount == 4) triangle.chart[k] = quad[corners[k]];
    const std::optional<glm::dvec3>& color = obj.colors[corner.position];
    colored = colored && color.has_value();
    colors[k] = color.value_or(glm::dvec3(0.0));
  }
  if (colored) triangle.cornerColor = colors;
  return triangle;
}

/// Counts faces with a fault, for a warning that names the first.
struct FaceCount {
  int count = 0;
  int firstLine = 0;

  void add(int line) {
    if (count++ == 0) firstLine = line;
  }
  void warn(std::vector<std::string>& warnings, const std::string& what) const {
    if (count == 0) return;
    const std::string faces = count == 1 ? "1 face " : std::to_string(count) + " faces ";
    warnings.push_back(faces + what + " (line " + std::to_string(firstLine) + (count == 1 ? ")" : " first)"));
  }
};

std::vector<glm::dvec3> positionsOf(const ObjFile& obj, const ObjPolygon& polygon) {
  std::vector<glm::dvec3> positions;
  for (const ObjCorner& corner : std::span(obj.corners).subspan(polygon.firstCorner, polygon.cornerCount)) {
    positions.push_back(obj.positions[corner.position]);
  }
  return positions;
}

/// One section per section of the file; some may be empty.
std::vector<Section> cutPolygons(const ObjFile& obj, std::vector<std::string>& warnings) {
  std::vector<Section> sections(obj.sections.size());
  FaceCount degenerate, crossing;
  for (std::uint32_t p = 0; p < obj.polygons.size(); ++p) {
    const ObjPolygon& polygon = obj.polygons[p];
    const std::vector<glm::dvec3> positions = positionsOf(obj, polygon);
    const Triangulation cut = triangulate(positions);
    std::vector<Triangle>& triangles = sections[polygon.section].triangles;
    const std::size_t before = triangles.size();
    for (const std::array<std::uint32_t, 3>& t : cut.triangles) {
      if (hasArea(positions[t[0]], positions[t[1]], positions[t[2]])) triangles.push_back(makeTriangle(obj, p, t));
    }
    const bool isDegenerate = triangles.size() == before;
    if (isDegenerate) degenerate.add(polygon.line);
    if (cut.crossing && !isDegenerate) crossing.add(polygon.line);
  }
  degenerate.warn(warnings, "without area dropped");
  crossing.warn(warnings, "that cross themselves triangulated as well as can be");
  return sections;
}

}  // namespace

std::vector<Section> cutIntoSections(const ObjFile& obj, std::vector<std::string>& warnings) {
  std::vector<Section> sections = cutPolygons(obj, warnings);
  std::map<std::string, int> sectionsOfGroup;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (!sections[s].triangles.empty()) ++sectionsOfGroup[obj.sections[s].group];
  }
  std::set<std::string> taken;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (sections[s].triangles.empty()) continue;
    const auto& [group, material] = obj.sections[s];
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
