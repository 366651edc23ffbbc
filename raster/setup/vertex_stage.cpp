#include "raster/setup/vertex_stage.h"

#include <algorithm>
#include <cmath>

namespace hemitex::raster {
namespace {

/// The point where the edge from `inside` to `outside` leaves a half-space. It is always computed from the inside end,
/// so that two triangles that share the edge get the same point.
ViewVertex crossing(HalfSpace halfSpace, const ViewVertex& inside, const ViewVertex& outside, double nearDistance) {
  const double fromInside = distance(halfSpace, inside, nearDistance);
  const double t = fromInside / (fromInside - distance(halfSpace, outside, nearDistance));
  const auto between = [t](double a, double b) { return a + t * (b - a); };
  const double w = between(inside.w, outside.w);
  return {between(inside.x, outside.x), between(inside.y, outside.y),
          halfSpace == HalfSpace::Near ? nearDistance : std::max(w, nearDistance), between(inside.u, outside.u),
          between(inside.v, outside.v)};
}

/// Whether clipping would leave the polygon unchanged.
bool isInside(const ClippedPolygon& polygon, HalfSpace halfSpace, double nearDistance) {
  return std::all_of(polygon.vertices.begin(), polygon.vertices.begin() + polygon.count,
                     [=](const ViewVertex& vertex) { return distance(halfSpace, vertex, nearDistance) >= 0; });
}

ClippedPolygon clip(const ClippedPolygon& polygon, HalfSpace halfSpace, double nearDistance) {
  ClippedPolygon result;
  for (int i = 0; i < polygon.count; ++i) {
    const ViewVertex& start = polygon.vertices[static_cast<std::size_t>(i)];
    const ViewVertex& end = polygon.vertices[static_cast<std::size_t>((i + 1) % polygon.count)];
    const bool startInside = distance(halfSpace, start, nearDistance) >= 0;
    const bool endInside = distance(halfSpace, end, nearDistance) >= 0;
    const auto emit = [&result](const ViewVertex& vertex) {
      result.vertices[static_cast<std::size_t>(result.count++)] = vertex;
    };
    if (startInside) emit(start);
    if (startInside && !endInside) emit(crossing(halfSpace, start, end, nearDistance));
    if (!startInside && endInside) emit(crossing(halfSpace, end, start, nearDistance));
  }
  return result;
}

}  // namespace

double distance(HalfSpace halfSpace, const ViewVertex& p, double nearDistance) {
  switch (halfSpace) {
    case HalfSpace::Near:
      return p.w - nearDistance;
    case HalfSpace::Right:
      return guardBand * p.w - p.x;
    case HalfSpace::Left:
      return guardBand * p.w + p.x;
    case HalfSpace::Top:
      return guardBand * p.w - p.y;
    case HalfSpace::Bottom:
      return guardBand * p.w + p.y;
  }
  return 0;
}

ViewVertex transform(const Face& face, const glm::vec3& position, const glm::vec2& texcoord) {
  const float dx = position.x - face.eye.x, dy = position.y - face.eye.y, dz = position.z - face.eye.z;
  const auto along = [=](const glm::vec3& row) { return (row.x * dx + row.y * dy) + row.z * dz; };
  return {along(face.x), along(face.y), along(face.w), texcoord.x, texcoord.y};
}

bool isFinite(const ViewVertex& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.w) && std::isfinite(p.u) && std::isfinite(p.v);
}

ClippedPolygon clip(const std::array<ViewVertex, 3>& triangle, double nearDistance) {
  ClippedPolygon polygon;
  std::copy(triangle.begin(), triangle.end(), polygon.vertices.begin());
  polygon.count = 3;
  for (const HalfSpace halfSpace : halfSpaces)
    if (!isInside(polygon, halfSpace, nearDistance)) polygon = clip(polygon, halfSpace, nearDistance);
  return polygon;
}

}  // namespace hemitex::raster
