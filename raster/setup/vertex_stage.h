/// The vertex stage and clipping (raster rules, 2 and 3): triangles of the scene become convex polygons in front of
/// the near plane and inside the guard band, eight times the view, where snapped coordinates stay small integers.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "raster/interface/face.h"

namespace hemitex::raster {

/// A vertex in a face's coordinates: depth w along the view, x/w and y/w on the picture plane.
struct ViewVertex {
  double x, y, w;
  double u, v;
};

/// A polygon; no vertices where nothing is left. Five half-spaces add a vertex each to a convex polygon; rounding can
/// make it a hair concave, and then a half-space multiplies the vertices by at most 3/2: 3, 4, 6, 9, 13, 19.
struct ClippedPolygon {
  std::array<ViewVertex, 19> vertices;
  int count = 0;
};

/// The vertex stage: computed in binary32, in the order of the rules, then widened.
ViewVertex transform(const Face& face, const glm::vec3& position, const glm::vec2& texcoord);

bool isFinite(const ViewVertex& vertex);

/// The half-spaces that triangles are clipped to: w >= n, x <= 8w, -x <= 8w, y <= 8w, -y <= 8w.
enum class HalfSpace { Near, Right, Left, Top, Bottom };
/// In the order of clipping.
constexpr std::array<HalfSpace, 5> halfSpaces = {HalfSpace::Near, HalfSpace::Right, HalfSpace::Left, HalfSpace::Top,
                                                 HalfSpace::Bottom};

/// w - n, 8w - x, 8w + x, 8w - y or 8w + y: what lies outside has a negative one.
double distance(HalfSpace halfSpace, const ViewVertex& vertex, double nearDistance);

/// Sutherland-Hodgman against the near plane and the guard band, in binary64. All vertices are finite.
ClippedPolygon clip(const std::array<ViewVertex, 3>& triangle, double nearDistance);

}  // namespace hemitex::raster
