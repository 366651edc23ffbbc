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
#include <functional>
#include <optional>
#include <vector>

#include "raster/plain/rules.h"
#include "reference/conformance/verdict/device_profile.h"

namespace hemitex::reference {

/// A triangle by the rules, and how far a device may move it. Lengths are in sub-pixels of the rules, 1/256 pixel.
struct DeviceTriangle : raster::SnappedTriangle {
  std::array<glm::dvec2, 3> reaches = {};  ///< maximum distance of the device's corners, along each axis
  glm::dvec2 reach = {};                   ///< maximum over the corners
  double depthSlack = 0;                   ///< relative error of 1/w from the vertex stage
  glm::dvec2 largest = {};                 ///< maximum of |u| and of |v| over the corners before clipping
  double nearestDepth = 0;  ///< minimum of w over all corners after clipping, also of the other triangles of the fan
  bool mayFlip = false;     ///< whether the reach allows the other facing

  /// The corner by the rules. It is an integer below 2^23, so that edge functions are exact in binary64.
  glm::dvec2 corner(std::size_t k) const { return {corners[k % 3].x, corners[k % 3].y}; }
};

/// The smallest and largest coordinates of the corners.
struct Extent {
  glm::dvec2 low, high;
};

inline Extent extentOf(const DeviceTriangle& triangle) {
  const glm::dvec2 a = triangle.corner(0), b = triangle.corner(1), c = triangle.corner(2);
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

/// The triangles of a list in draw order, clipped, cut into fans and snapped by the rules, with their reach. With
/// `loose`, a device may clip a triangle that leaves the view at other planes. All vertices of such a triangle get the
/// largest error of its corners and of any snapping. Triangles for which `isWanted` is false are left out.
std::vector<DeviceTriangle> placeTriangles(const raster::DrawList& list, const raster::Face& face,
                                           const DeviceProfile& profile, bool loose,
                                           const std::function<bool(const DeviceTriangle&)>& isWanted);

/// Bounds of depth and texture coordinates of a triangle at a sample.
struct Region {
  double nearest, farthest;  ///< -z/w: 1/w of a scene
  double leastInverse;       ///< of 1/w
  glm::dvec2 low, high;      ///< (u, v)
};

/// The texel of the rules at a coordinate times the size of the map: its floor, clamped to the map.
inline std::size_t texelAt(double position, int size) {
  return static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, size - 1.0));
}

/// The bounds of a triangle at a sample; nothing where it cannot cover the sample.
std::optional<Region> regionAt(const DeviceTriangle& triangle, const glm::dvec2& sample, EdgeRule rule);

/// Whether the edge from vertex k to the next may pass over the sample.
bool edgeMayPass(const DeviceTriangle& triangle, std::size_t k, const glm::dvec2& sample, EdgeRule rule);

}  // namespace hemitex::reference
