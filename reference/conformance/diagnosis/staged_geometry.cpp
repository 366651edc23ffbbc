#include "reference/conformance/diagnosis/staged_geometry.h"

#include <algorithm>
#include <cmath>

#include "reference/conformance/trace/fragments.h"

namespace hemitex::reference {
namespace {

glm::dvec4 transformByRules(const raster::Face& face, const glm::vec3& position) {
  const raster::ViewVertex vertex = raster::transform(face, position, {0, 0});
  return {vertex.x, vertex.y, vertex.w - static_cast<double>(face.nearDistance), vertex.w};
}

ClipPolygon clipByRules(const ClipPolygon& polygon) {
  return clipAtSides(raster::guardBand, clipAt({0, 0, 1, 0}, polygon));
}

/// The clipped polygon of triangle t; empty if a value is not finite.
ClipPolygon polygonOf(const StagedGeometry& geometry, const raster::DrawList& list, const raster::Face& face,
                      std::uint32_t t) {
  ClipPolygon corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t index = list.indices[3 * std::size_t{t} + k];
    const ClipVertex& corner =
        corners.emplace_back(ClipVertex{geometry.transform(face, list.positions[index]), list.texcoords[index]});
    if (!std::isfinite(corner.position.x + corner.position.y + corner.position.z + corner.position.w) ||
        !std::isfinite(corner.texcoord.x + corner.texcoord.y))
      return {};
  }
  return geometry.clip(corners);
}

DeviceVertex place(const StagedGeometry& geometry, const ClipVertex& vertex, int resolution) {
  const glm::dvec4& p = vertex.position;
  DeviceVertex placed{{p.x, p.y, p.w, vertex.texcoord.x, vertex.texcoord.y}, {}, {}};
  for (int axis = 0; axis < 2; ++axis) {
    const double q = std::clamp(p[axis] / p.w, -raster::guardBand, raster::guardBand);
    placed.position[axis] = geometry.snap((q + 1) * 128 * resolution);
  }
  return placed;
}

}  // namespace

ClipPolygon clipAt(const glm::dvec4& plane, const ClipPolygon& polygon) {
  ClipPolygon clipped;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ClipVertex &start = polygon[k], &end = polygon[(k + 1) % polygon.size()];
    const double atStart = glm::dot(plane, start.position), atEnd = glm::dot(plane, end.position);
    if (atStart >= 0) clipped.push_back(start);
    if ((atStart >= 0) == (atEnd >= 0)) continue;
    // From the inside end, so that two triangles that share the edge get the same point.
    const bool isStartInside = atStart >= 0;
    const ClipVertex &inside = isStartInside ? start : end, &outside = isStartInside ? end : start;
    const double atInside = isStartInside ? atStart : atEnd, atOutside = isStartInside ? atEnd : atStart;
    const double t = atInside / (atInside - atOutside);
    clipped.push_back({inside.position + t * (outside.position - inside.position),
                       inside.texcoord + t * (outside.texcoord - inside.texcoord)});
  }
  return clipped;
}

ClipPolygon clipAtSides(double size, ClipPolygon polygon) {
  for (const int axis : {0, 1})
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec4 plane(0, 0, 0, size);
      plane[axis] = sign;
      polygon = clipAt(plane, polygon);
    }
  return polygon;
}

StagedGeometry::StagedGeometry()
    : transform(transformByRules), clip(clipByRules), snap([](double position) { return std::nearbyint(position); }) {}

std::vector<DeviceTriangle> placeTriangles(const StagedGeometry& geometry, const raster::DrawList& list,
                                           const raster::Face& face) {
  const bool isMirrored = raster::determinant(face) < 0;
  std::vector<DeviceTriangle> triangles;
  for (const DrawnTriangle& drawn : drawnTriangles(list)) {
    const ClipPolygon polygon = polygonOf(geometry, list, face, drawn.triangle);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      DeviceTriangle triangle{};
      triangle.triangle = drawn.triangle;
      triangle.draw = drawn.draw;
      const std::array<std::size_t, 3> fan{0, k - 1, k};
      for (std::size_t j = 0; j < 3; ++j) triangle.vertices[j] = place(geometry, polygon[fan[j]], face.resolution);
      triangle.area = doubledArea(triangle.vertices);
      triangle.facesAway = (triangle.area < 0) == isMirrored;
      const auto isAhead = [](const DeviceVertex& vertex) { return vertex.view.w > 0; };
      // Without area, or where a position is not a number, there is nothing to draw.
      if (std::abs(triangle.area) > 0 && std::all_of(triangle.vertices.begin(), triangle.vertices.end(), isAhead))
        triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace hemitex::reference
