#include "radiosity/scene/section_charts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "radiosity/base/text_lines.h"
#include "radiosity/geometry/chart_validation.h"
#include "radiosity/geometry/mesh_charts.h"

namespace hemitex::radiosity {
namespace {

using Triangles = std::vector<Triangle>;

/// The cosine of the crease angle without a setting, 40 degrees.
constexpr double creaseCosine = 0.766044443118978;
/// The cosine of 60 degrees. Normals of the file do not make a sharper edge smooth: light differs on its two sides.
constexpr double sharpCosine = 0.5;

std::string describe(const ChartConflict& conflict, const Triangles& triangles, const PolygonMesh& mesh) {
  const auto face = [&](std::uint32_t triangle) {
    return "the face (" + placeOf(mesh, triangles[triangle].polygon) + ")";
  };
  switch (conflict.kind) {
    case ChartConflict::Kind::Outside:
      return face(conflict.triangle) + " leaves the unit square";
    case ChartConflict::Kind::NoArea:
      return face(conflict.triangle) + " has no area in them";
    case ChartConflict::Kind::Overlap:
      break;
  }
  return face(conflict.triangle) + " overlaps " + face(conflict.other);
}

/// Uses the file's coordinates if they form a chart. Otherwise changes nothing and returns the reason.
std::optional<std::string> layFromFile(Triangles& triangles, const PolygonMesh& mesh) {
  std::vector<ChartTriangle> charts;
  for (const Triangle& triangle : triangles) {
    const MeshPolygon& polygon = mesh.polygons[triangle.polygon];
    if (!polygon.textured) return "the face (" + placeOf(mesh, triangle.polygon) + ") has none";
    charts.push_back(roundedChart(triangle.texcoord));
  }
  const std::vector<ChartConflict> conflicts = chartConflicts(charts, 1);
  if (!conflicts.empty()) return describe(conflicts[0], triangles, mesh);
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].chart = charts[i];
  return {};
}

bool isLoneQuad(const Triangles& triangles, const PolygonMesh& mesh) {
  return triangles.front().polygon == triangles.back().polygon &&
         mesh.polygons[triangles.front().polygon].cornerCount == 4;
}

/// A list of one surface. A list in braces would copy the triangles.
std::vector<Surface> oneSurface(Triangles triangles) {
  std::vector<Surface> surfaces(1);
  surfaces.front().triangles = std::move(triangles);
  return surfaces;
}

std::vector<TrianglePositions> positionsOf(const Triangles& triangles) {
  std::vector<TrianglePositions> positions;
  positions.reserve(triangles.size());
  for (const Triangle& triangle : triangles) positions.push_back(triangle.position);
  return positions;
}

/// Numbers for the faces of triangles (see planarParts). Each triangle of a polygon that crosses itself is a face.
std::vector<std::uint32_t> facesOf(const Section& section, const PolygonMesh& mesh) {
  std::vector<std::uint32_t> faces;
  faces.reserve(section.triangles.size());
  auto next = static_cast<std::uint32_t>(mesh.polygons.size());
  for (const Triangle& triangle : section.triangles)
    faces.push_back(section.crossing.count(triangle.polygon) > 0 ? next++ : triangle.polygon);
  return faces;
}

/// One surface per part.
std::vector<Surface> divided(Triangles triangles, const std::vector<ChartedPart>& parts) {
  if (parts.size() == 1) {  // without a copy: the part has all triangles
    for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].chart = parts.front().charts[i];
    std::vector<Surface> whole = oneSurface(std::move(triangles));
    whole.front().curvedPart = parts.front().component;
    return whole;
  }
  std::vector<Surface> surfaces(parts.size());
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const ChartedPart& part = parts[s];
    surfaces[s].curvedPart = part.component;
    surfaces[s].triangles.reserve(part.triangles.size());
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      surfaces[s].triangles.push_back(triangles[part.triangles[i]]);
      surfaces[s].triangles.back().chart = part.charts[i];
    }
  }
  return surfaces;
}

/// The mesh of a section, which knows its smooth edges.
class SectionMesh {
 public:
  SectionMesh(const Section& section, const std::optional<double>& crease)
      : section_(section),
        crease_(crease ? std::cos(*crease * std::numbers::pi / 180) : creaseCosine),
        hasNormals_(!crease && !section.normals.empty()),
        positions_(positionsOf(section.triangles)),
        edges_(findEdges(positions_)) {}

  const std::vector<TrianglePositions>& positions() const { return positions_; }
  const MeshEdges& edges() const { return edges_; }

  /// Two triangles in one plane always continue each other. Otherwise they do if no third one shares the
  /// edge, they wind alike, and the normals of the file, or else the angle between them, say so.
  bool isSmooth(std::uint32_t halfEdge, std::uint32_t other) const {
    const glm::dvec3 a = unitNormal(positions_[halfEdge / 3]), b = unitNormal(positions_[other / 3]);
    if (areParallel(a, b)) return true;
    if (edges_.around(edges_.edge[halfEdge]).size() != 2 || edges_.vertex[halfEdge] == edges_.vertex[other])
      return false;
    if (!hasNormals_) return glm::dot(a, b) >= crease_;
    const auto isEqual = [&](std::uint32_t corner, std::uint32_t twin) {
      return glm::distance(section_.normals[corner / 3][corner % 3], section_.normals[twin / 3][twin % 3]) <=
             normalTolerance;
    };
    return glm::dot(a, b) >= sharpCosine && isEqual(halfEdge, nextCorner(other)) &&
           isEqual(nextCorner(halfEdge), other);
  }

  const glm::dvec2& chartOf(std::uint32_t corner) const { return section_.triangles[corner / 3].chart[corner % 3]; }

  /// Whether the charts of two triangles share the edge, too.
  bool isJoined(std::uint32_t halfEdge, std::uint32_t other) const {
    if (edges_.vertex[halfEdge] == edges_.vertex[other])
      return chartOf(halfEdge) == chartOf(other) && chartOf(nextCorner(halfEdge)) == chartOf(nextCorner(other));
    return chartOf(halfEdge) == chartOf(nextCorner(other)) && chartOf(nextCorner(halfEdge)) == chartOf(other);
  }

 private:
  const Section& section_;
  double crease_;
  bool hasNormals_;
  std::vector<TrianglePositions> positions_;
  MeshEdges edges_;
};

/// Whether two triangles share an edge of the chart that is a crease. A texel there would hold light of both sides,
/// unless the edge runs along borders of texels, as multiples of a quarter do in grids of 4, 8, 16, ... texels.
bool isFolded(const SectionMesh& mesh) {
  const auto isAlongQuarter = [](double a, double b) { return a == b && 4 * a == std::floor(4 * a); };
  for (std::uint32_t e = 0; e < mesh.edges().count(); ++e) {
    const std::span<const std::uint32_t> around = mesh.edges().around(e);
    const glm::dvec2 from = mesh.chartOf(around[0]), to = mesh.chartOf(nextCorner(around[0]));
    if (isAlongQuarter(from.x, to.x) || isAlongQuarter(from.y, to.y)) continue;
    for (std::size_t i = 1; i < around.size(); ++i)
      if (mesh.isJoined(around[0], around[i]) && !mesh.isSmooth(around[0], around[i])) return true;
  }
  return false;
}

/// The parts of a chart between creases, each scaled to the unit square.
std::vector<ChartedPart> cutAtCreases(const Triangles& triangles, const SectionMesh& mesh) {
  const TriangleSets sets = connectedSets(mesh.edges(), [&](std::uint32_t halfEdge, std::uint32_t other) {
    return mesh.isJoined(halfEdge, other) && mesh.isSmooth(halfEdge, other);
  });
  std::vector<ChartedPart> parts;
  for (const std::vector<std::uint32_t>& set : sets.triangles) {
    std::vector<ChartTriangle> charts;
    for (const std::uint32_t t : set) charts.push_back(triangles[t].chart);
    parts.push_back({set, scaledToSquare(std::move(charts))});
  }
  return parts;
}

std::vector<Surface> lay(Section section, const PolygonMesh& mesh, const std::filesystem::path& file,
                         const SceneSettings& settings) {
  if (settings.charts == Charts::Planar) {
    const std::vector<ChartedPart> parts = planarParts(positionsOf(section.triangles), facesOf(section, mesh));
    return divided(std::move(section.triangles), parts);
  }
  const std::optional<std::string> fault = layFromFile(section.triangles, mesh);
  if (settings.charts == Charts::File) {
    if (fault)
      fail({file}, "the texture coordinates of surface '" + section.family + "' form no chart: " + *fault,
           "choose other charts, or mend the coordinates");
    return oneSurface(std::move(section.triangles));
  }
  // Quads have the chart of their corners already.
  if (isLoneQuad(section.triangles, mesh)) return oneSurface(std::move(section.triangles));
  const SectionMesh edges(section, settings.crease);
  if (!fault && !isFolded(edges)) return oneSurface(std::move(section.triangles));
  const std::vector<ChartedPart> parts =
      fault ? curvedParts(edges.positions(), edges.edges(), facesOf(section, mesh),
                          [&](std::uint32_t h, std::uint32_t other) { return edges.isSmooth(h, other); })
            : cutAtCreases(section.triangles, edges);
  return divided(std::move(section.triangles), parts);
}

}  // namespace

std::vector<Surface> layCharts(Section section, const PolygonMesh& mesh, const std::filesystem::path& file,
                               const SceneSettings& settings) {
  std::vector<Surface> surfaces = lay(std::move(section), mesh, file, settings);
  for (Surface& surface : surfaces) {
    for (Triangle& triangle : surface.triangles) {
      if (!mesh.polygons[triangle.polygon].textured) triangle.texcoord = triangle.chart;
    }
  }
  return surfaces;
}

}  // namespace hemitex::radiosity
