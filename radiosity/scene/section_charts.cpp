#include "radiosity/scene/section_charts.h"

#include <optional>
#include <string>
#include <utility>

#include "radiosity/geometry/chart_validation.h"
#include "radiosity/geometry/planar_charts.h"
#include "radiosity/scene/obj_lines.h"

namespace hemitex::radiosity {
namespace {

using Triangles = std::vector<Triangle>;

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
std::vector<Triangles> oneSurface(Triangles triangles) {
  std::vector<Triangles> surfaces;
  surfaces.push_back(std::move(triangles));
  return surfaces;
}

std::vector<PlanarPart> planarPartsOf(const Triangles& triangles) {
  std::vector<TrianglePositions> positions;
  positions.reserve(triangles.size());
  for (const Triangle& triangle : triangles) positions.push_back(triangle.position);
  return planarParts(positions);
}

std::vector<Triangles> layPlanar(Triangles triangles) {
  const std::vector<PlanarPart> parts = planarPartsOf(triangles);
  if (parts.size() == 1) {  // without a copy: the part has all triangles
    for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].chart = parts.front().charts[i];
    return oneSurface(std::move(triangles));
  }
  std::vector<Triangles> surfaces;
  for (const PlanarPart& part : parts) {
    Triangles& surface = surfaces.emplace_back();
    surface.reserve(part.triangles.size());
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      surface.push_back(triangles[part.triangles[i]]);
      surface.back().chart = part.charts[i];
    }
  }
  return surfaces;
}

std::vector<Triangles> lay(Section section, const PolygonMesh& mesh, const std::filesystem::path& file, Charts charts) {
  if (charts == Charts::Planar) return layPlanar(std::move(section.triangles));
  const std::optional<std::string> fault = layFromFile(section.triangles, mesh);
  if (fault && charts == Charts::File) {
    fail({file}, "the texture coordinates of surface '" + section.family + "' form no chart: " + *fault,
         "choose other charts, or mend the coordinates");
  }
  // Quads have the chart of their corners already.
  if (!fault || isLoneQuad(section.triangles, mesh)) return oneSurface(std::move(section.triangles));
  return layPlanar(std::move(section.triangles));
}

}  // namespace

std::vector<std::vector<Triangle>> layCharts(Section section, const PolygonMesh& mesh,
                                             const std::filesystem::path& file, Charts charts) {
  std::vector<Triangles> surfaces = lay(std::move(section), mesh, file, charts);
  for (Triangles& surface : surfaces) {
    for (Triangle& triangle : surface) {
      if (!mesh.polygons[triangle.polygon].textured) triangle.texcoord = triangle.chart;
    }
  }
  return surfaces;
}

}  // namespace hemitex::radiosity
