#include "radiosity/scene/mesh_sections.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <tuple>

#include "radiosity/base/bytes.h"
#include "radiosity/base/unique_names.h"
#include "radiosity/geometry/mesh_charts.h"
#include "radiosity/geometry/triangulation.h"

namespace hemitex::radiosity {
namespace {

Triangle makeTriangle(const PolygonMesh& mesh, std::uint32_t polygonIndex,
                      const std::array<std::uint32_t, 3>& corners) {
  constexpr std::array<glm::dvec2, 4> quad{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)};
  const MeshPolygon& polygon = mesh.polygons[polygonIndex];
  Triangle triangle;
  triangle.polygon = polygonIndex;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshCorner& corner = mesh.corners[polygon.firstCorner + corners[k]];
    triangle.position[k] = mesh.positions[corner.position];
    if (!mesh.colours.empty()) triangle.colour[k] = mesh.colours[corner.position];
    if (polygon.textured) triangle.texcoord[k] = mesh.texcoords[*corner.texcoord];
    if (polygon.cornerCount == 4) triangle.chart[k] = quad[corners[k]];
  }
  return triangle;
}

/// The unit normals of the file at corners of a polygon; nothing if one is missing, or has no finite length above 0.
std::optional<std::array<glm::vec3, 3>> cornerNormals(const PolygonMesh& mesh, const MeshPolygon& polygon,
                                                      const std::array<std::uint32_t, 3>& corners) {
  std::array<glm::vec3, 3> normals{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<std::uint32_t> index = mesh.corners[polygon.firstCorner + corners[k]].normal;
    if (!index) return {};
    const glm::dvec3& normal = mesh.normals[*index];
    const double length = glm::length(normal);
    if (!(length > 0 && std::isfinite(length))) return {};
    normals[k] = normal / length;
  }
  return normals;
}

/// Sets the normals of the sections, where the file has them.
void addNormals(const PolygonMesh& mesh, Section& section, const Triangle& triangle,
                const std::array<std::uint32_t, 3>& corners) {
  if (mesh.normals.empty() || section.normals.size() + 1 != section.triangles.size()) return;
  if (const auto normals = cornerNormals(mesh, mesh.polygons[triangle.polygon], corners))
    section.normals.push_back(*normals);
}

/// Whether all normals are those of the faces.
bool areOfFaces(const Section& section) {
  for (std::size_t t = 0; t < section.normals.size(); ++t) {
    const glm::dvec3 ofFace = unitNormal(section.triangles[t].position);
    for (const glm::vec3& normal : section.normals[t])
      if (glm::distance(glm::dvec3(normal), ofFace) > normalTolerance) return false;
  }
  return true;
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

/// The corners of a polygon, from the smallest position on.
std::vector<glm::dvec3> fromSmallest(std::vector<glm::dvec3> positions) {
  const auto isBefore = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::rotate(positions.begin(), std::min_element(positions.begin(), positions.end(), isBefore), positions.end());
  return positions;
}

/// Makes room for the triangles of all polygons, so that the lists are not copied as they grow.
void reserveTriangles(const PolygonMesh& mesh, std::vector<Section>& sections) {
  std::vector<std::size_t> counts(sections.size());
  for (const MeshPolygon& polygon : mesh.polygons) counts[polygon.section] += polygon.cornerCount - 2;
  for (std::size_t s = 0; s < sections.size(); ++s) sections[s].triangles.reserve(counts[s]);
}

/// One section per section of the file; some may be empty.
std::vector<Section> cutPolygons(const PolygonMesh& mesh, bool areFacets, std::vector<std::string>& warnings) {
  std::vector<Section> sections(mesh.sections.size());
  reserveTriangles(mesh, sections);
  // Equal polygons of a section have the same chart. Of different sections the last one covers (see contacts.h).
  const std::vector<std::uint32_t> first = firstOfEqual(mesh);
  FaceCount degenerate, crossing, repeated;
  for (std::uint32_t p = 0; p < mesh.polygons.size(); ++p) {
    if (first[p] != p && (areFacets || mesh.polygons[first[p]].section == mesh.polygons[p].section)) {
      repeated.add(mesh, p);
      continue;
    }
    const MeshPolygon& polygon = mesh.polygons[p];
    const std::vector<glm::dvec3> positions = positionsOf(mesh, polygon);
    const Triangulation cut = triangulate(positions);
    std::vector<Triangle>& triangles = sections[polygon.section].triangles;
    const std::size_t before = triangles.size();
    for (const std::array<std::uint32_t, 3>& t : cut.triangles) {
      if (!hasArea(positions[t[0]], positions[t[1]], positions[t[2]])) continue;
      triangles.push_back(makeTriangle(mesh, p, t));
      addNormals(mesh, sections[polygon.section], triangles.back(), t);
    }
    const bool isDegenerate = triangles.size() == before;
    if (isDegenerate) degenerate.add(mesh, p);
    if (cut.crossing) sections[polygon.section].crossing.insert(p);
    if (cut.crossing && !isDegenerate) crossing.add(mesh, p);
  }
  repeated.warn(warnings, "left out, because another has the same corners");
  degenerate.warn(warnings, "without area dropped");
  crossing.warn(warnings, "that cross themselves triangulated as well as can be");
  for (Section& section : sections)
    if (section.normals.size() != section.triangles.size() || areOfFaces(section)) section.normals.clear();
  return sections;
}

}  // namespace

std::vector<std::uint32_t> firstOfEqual(const PolygonMesh& mesh) {
  const auto materialOf = [&](std::uint32_t p) -> const std::string& {
    return mesh.sections[mesh.polygons[p].section].material;
  };
  const auto cornersOf = [&](std::uint32_t p) { return fromSmallest(positionsOf(mesh, mesh.polygons[p])); };
  std::vector<std::pair<std::size_t, std::uint32_t>> hashes;
  hashes.reserve(mesh.polygons.size());
  for (std::uint32_t p = 0; p < mesh.polygons.size(); ++p) {
    std::string bytes;
    for (const glm::dvec3& corner : cornersOf(p)) appendBytes(bytes, corner + 0.0);  // -0 is 0
    hashes.emplace_back(std::hash<std::string>()(bytes), p);
  }
  std::sort(hashes.begin(), hashes.end());
  std::vector<std::uint32_t> first(mesh.polygons.size());
  for (std::size_t begin = 0, end = 0; begin < hashes.size(); begin = end) {
    std::vector<std::uint32_t> different;
    for (; end < hashes.size() && hashes[end].first == hashes[begin].first; ++end) {
      const std::uint32_t p = hashes[end].second;
      const auto known = std::find_if(different.begin(), different.end(), [&](std::uint32_t earlier) {
        return materialOf(earlier) == materialOf(p) && cornersOf(earlier) == cornersOf(p);
      });
      first[p] = known == different.end() ? p : *known;
      if (first[p] == p) different.push_back(p);
    }
  }
  return first;
}

std::vector<Section> cutIntoSections(const PolygonMesh& mesh, bool areFacets, std::vector<std::string>& warnings) {
  std::vector<Section> sections = cutPolygons(mesh, areFacets, warnings);
  std::vector<int> sectionsOfObject(mesh.objects.size());
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (!sections[s].triangles.empty()) ++sectionsOfObject[mesh.sections[s].object];
  }
  UniqueNames names;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (sections[s].triangles.empty()) continue;
    const auto& [object, material] = mesh.sections[s];
    const std::string &name = mesh.objects[object].name, suffix = "/" + (material.empty() ? "default" : material);
    sections[s].family = names.add(sectionsOfObject[object] > 1 ? name + suffix : name);
    sections[s].material = material;
    sections[s].object = object;
  }
  std::erase_if(sections, [](const Section& section) { return section.triangles.empty(); });
  std::stable_sort(sections.begin(), sections.end(),
                   [](const Section& a, const Section& b) { return a.object < b.object; });
  return sections;
}

}  // namespace hemitex::radiosity
