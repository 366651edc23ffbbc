/// The vertex stage and clipping (docs/item-buffers.md, "view" and "clip"). Clipping makes convex polygons in front of
/// the near plane and inside the guard band, which is eight times the view. There snapped coordinates are small
/// integers.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "raster/interface/face.h"

namespace hemitex::raster {

/// A vertex in view coordinates: depth w along the view; x/w and y/w on the picture plane.
struct ViewVertex {
  double x, y, w;
  double u, v;
};

/// A clipped polygon; no vertices if nothing is left. Each of the five half-spaces adds at most one vertex to a convex
/// polygon. Rounding can make the polygon slightly non-convex. Then a half-space multiplies the number of vertices by
/// at most 3/2: 3, 4, 6, 9, 13, 19.
struct ClippedPolygon {
  std::array<ViewVertex, 19> vertices;
  int count = 0;
};

/// The vertex stage: computed in binary32 in the order of docs/item-buffers.md, "view", then converted to double.
ViewVertex transform(const Face& face, const glm::vec3& position, const glm::vec2& texcoord);

bool isFinite(const ViewVertex& vertex);

/// Vertices are clipped at |x| = 8w and |y| = 8w.
inline constexpr double guardBand = 8;

/// The half-spaces for clipping: w >= n, x <= 8w, -x <= 8w, y <= 8w, -y <= 8w.
enum class HalfSpace { Near, Right, Left, Top, Bottom };
/// In the order of clipping.
constexpr std::array<HalfSpace, 5> halfSpaces = {HalfSpace::Near, HalfSpace::Right, HalfSpace::Left, HalfSpace::Top,
                                                 HalfSpace::Bottom};

/// w - n, 8w - x, 8w + x, 8w - y or 8w + y: negative outside the half-space.
double distance(HalfSpace halfSpace, const ViewVertex& vertex, double nearDistance);

/// Sutherland-Hodgman against the near plane and the guard band, in double precision. All vertices must be finite.
ClippedPolygon clip(const std::array<ViewVertex, 3>& triangle, double nearDistance);

}  // namespace hemitex::raster
