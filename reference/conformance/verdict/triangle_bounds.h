/// Triangles as a device may place them. A device within a profile (device_profile.h) computes each vertex with an
/// error and snaps it in its own way. So its vertex lies within the *reach* of the vertex of the raster rules.
///
/// Let s_k be the snapped vertices of the rules and s'_k those of a device, at most d apart along each axis. A sample p
/// inside the device's triangle is p = sum(b_k s'_k) with weights b_k >= 0 that sum to 1. The point p* = sum(b_k s_k)
/// of the rules' triangle has the same weights. So it has the same depth and texture coordinates, and |p - p*| <= d.
/// All that the device shows at p, the rules' triangle shows within the box of half-width d about p:
///
/// - The triangle *may cover* the sample only where it meets that box.
/// - Its depth and coordinates are those of a point in the intersection of triangle and box, a convex polygon. Over it
///   1/w is linear, and u and v are quotients of linear functions with a positive denominator. These are monotone along
///   any line, so their values at the corners of the polygon bound them.
/// - While vertices move from s_k to s'_k, an edge passes over p only if it meets the box of its two ends. A triangle
///   without such an edge covers p after the move if it did before. So does a mesh whose shared edges move together.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "raster/base/cross.h"
#include "raster/plain/rules.h"
#include "reference/conformance/verdict/device_profile.h"

namespace hemitex::reference {

/// Lengths are in sub-pixels of the rules, 1/256 pixel. Snapped positions are integers below 2^23, so edge functions
/// are exact in binary64.
struct DeviceVertex {
  raster::ViewVertex view;  ///< of the rules, after clipping: equal for the triangles that share a corner
  glm::dvec2 position;      ///< snapped by the rules
  glm::dvec2 reach;         ///< maximum distance of the device's position, along each axis
};

struct DeviceTriangle {
  std::array<DeviceVertex, 3> vertices;
  glm::dvec2 reach;        ///< maximum over the vertices
  double area;             ///< doubled and signed
  double depthSlack;       ///< relative error of 1/w from the vertex stage
  glm::dvec2 largest;      ///< maximum of |u| and of |v| over the corners before clipping
  double nearestDepth;     ///< minimum of w over all corners after clipping, also of the other triangles of the fan
  std::uint32_t triangle;  ///< indices 3t to 3t + 2
  std::uint32_t draw;
  bool facesAway;  ///< by the rules
  bool mayFlip;    ///< whether the reach allows the other facing
};

/// The smallest and largest coordinates of the placed vertices.
struct Extent {
  glm::dvec2 low, high;
};

inline Extent extentOf(const DeviceTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  return {glm::min(a.position, glm::min(b.position, c.position)),
          glm::max(a.position, glm::max(b.position, c.position))};
}

/// The triangles of a list in draw order, clipped, cut into fans and snapped by the rules, with their reach. With
/// `loose`, a device may clip a triangle that leaves the view at other planes. All vertices of such a triangle get the
/// largest error of its corners and of any snapping. Triangles for which `isWanted` is false are left out.
std::vector<DeviceTriangle> placeTriangles(const raster::DrawList& list, const raster::Face& face,
                                           const DeviceProfile& profile, bool loose,
                                           const std::function<bool(const DeviceTriangle&)>& isWanted);

/// Bounds of depth and texture coordinates of a triangle at a sample.
struct Region {
  double nearest, farthest;  ///< 1/w
  glm::dvec2 low, high;      ///< (u, v)
};

/// The sample of a pixel, in sub-pixels.
inline glm::dvec2 sampleOf(int column, int row) { return {256.0 * column + 128, 256.0 * row + 128}; }

/// Whether an edge along `direction`, with the interior on its right where rows grow downwards, is top or left: a top
/// edge runs to the right, a left edge up.
inline bool isTopOrLeft(const glm::dvec2& direction) {
  return direction.y < 0 || (direction.y == 0 && direction.x > 0);
}

/// The texel of the rules at a coordinate times the size of the map: its floor, clamped to the map.
inline std::size_t texelAt(double position, int size) {
  return static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, size - 1.0));
}

/// The doubled, signed area of three vertices as placed.
inline double doubledArea(const std::array<DeviceVertex, 3>& vertices) {
  return raster::cross(vertices[1].position - vertices[0].position, vertices[2].position - vertices[0].position);
}

/// The bounds of a triangle at a sample; nothing where it cannot cover the sample.
std::optional<Region> regionAt(const DeviceTriangle& triangle, const glm::dvec2& sample, EdgeRule rule);

/// Whether the rules' triangle covers the sample.
bool coversByRule(const DeviceTriangle& triangle, const glm::dvec2& sample);

/// 1/w by the rules at a covered sample, rounded to binary64.
double inverseDepthAt(const DeviceTriangle& triangle, const glm::dvec2& sample);

/// Whether the edge from vertex k to the next may pass over the sample.
bool edgeMayPass(const DeviceTriangle& triangle, std::size_t k, const glm::dvec2& sample, EdgeRule rule);

}  // namespace hemitex::reference
