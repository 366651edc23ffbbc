#include "reference/conformance/verdict/triangle_bounds.h"

#include <boost/container/static_vector.hpp>

#include "raster/base/cross.h"
#include "reference/conformance/trace/fragments.h"

namespace hemitex::reference {
namespace {

using raster::ViewVertex;

// --- reach of a vertex ---

/// The sum of absolute values of the terms of a vertex stage: |X.x| (|P.x| + |E.x|) + ... Roundings are relative to it,
/// for any order of the sum, and whether the eye is subtracted first or part of a 4x4 matrix.
double sumOfSizes(const glm::vec3& row, const glm::vec3& position, const glm::vec3& eye) {
  const glm::dvec3 sizes = glm::abs(glm::dvec3(position)) + glm::abs(glm::dvec3(eye));
  return glm::dot(glm::abs(glm::dvec3(row)), sizes);
}

/// A vertex with its sums of sizes in place of u (picture) and v (depth), so that clipping interpolates them. In clip
/// space there is no vertex stage.
ViewVertex withSizes(const ViewVertex& vertex, const raster::DrawList& list, const raster::Face& face,
                     std::uint32_t index) {
  if (list.clipDepth != raster::ClipDepth::None) return {vertex.x, vertex.y, vertex.w, 0, 0, vertex.z};
  const glm::vec3 position = list.positions[index];
  const double picture = std::max(sumOfSizes(face.x, position, face.eye), sumOfSizes(face.y, position, face.eye));
  return {vertex.x, vertex.y, vertex.w, picture, sumOfSizes(face.w, position, face.eye), vertex.z};
}

/// The snapping unit of a device in sub-pixels of the rules.
double snapUnit(const DeviceProfile& profile) { return std::ldexp(256.0, -profile.subpixelBits); }

/// The maximum distance from `snapped` at which a device snaps a position that it knows up to `error`.
double reachOf(const DeviceProfile& profile, double position, double error, double snapped) {
  if (profile.snapRounding == SnapRounding::None) return std::abs(position - snapped) + error;
  const double unit = snapUnit(profile);
  const double low = (position - error) / unit, high = (position + error) / unit;
  const bool nearest = profile.snapRounding == SnapRounding::Nearest;
  const double lowest = nearest ? std::ceil(low - 0.5) : std::floor(low);
  const double highest = nearest ? std::floor(high + 0.5) : std::floor(high);
  return std::max(std::abs(lowest * unit - snapped), std::abs(highest * unit - snapped));
}

/// The same for a vertex anywhere on an edge: the maximum snapping error of the device and of the rules.
double looseReachOf(const DeviceProfile& profile, double error) {
  const double ours = 0.5;
  if (profile.snapRounding == SnapRounding::None) return error + ours;
  return error + ours + snapUnit(profile) * (profile.snapRounding == SnapRounding::Nearest ? 0.5 : 1);
}

/// Places vertices on the viewport of a face.
struct Placement {
  const DeviceProfile& profile;
  glm::ivec2 pixels;  ///< of the viewport
  double roundoff;    ///< relative to sums of sizes

  /// Relative error of w.
  double depthSlack(const ViewVertex& sizes) const { return roundoff * sizes.v / sizes.w; }

  /// The error of q = x/w in sub-pixels: that of x and of w, then of the division and the viewport.
  double error(double q, int side, const ViewVertex& sizes) const {
    const double slack = depthSlack(sizes);
    const double unit = 128.0 * side;
    if (slack >= 0.5) return 2 * raster::guardBand * unit;
    const double relative = (roundoff * sizes.u / sizes.w + std::abs(q) * slack) / (1 - slack);
    return unit * (relative + roundoff * (std::abs(q) + 1));
  }

  /// The reach of a vertex along each axis.
  glm::dvec2 reach(const ViewVertex& view, const ViewVertex& sizes, bool loose) const {
    glm::dvec2 reach;
    const glm::dvec2 q(view.x / view.w, view.y / view.w);
    for (int axis = 0; axis < 2; ++axis) {
      const double position = raster::subPixels(q[axis], pixels[axis]), offBy = error(q[axis], pixels[axis], sizes);
      reach[axis] = loose ? looseReachOf(profile, offBy) : reachOf(profile, position, offBy, std::nearbyint(position));
    }
    return reach;
  }
};

// --- triangles ---

/// The doubled area is cross(s0, s1) + cross(s1, s2) + cross(s2, s0). Moving s_k by e_k changes it by the sums of
/// cross(e_k, s_{k+1} - s_{k-1}) and cross(e_k, e_{k+1}). The second sum is the doubled area of a triangle in a box of
/// sides 2 reach, so it is at most the area of the box.
double largestChangeOfArea(const DeviceTriangle& triangle) {
  const glm::dvec2& reach = triangle.reach;
  double change = 4 * reach.x * reach.y;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = glm::abs(triangle.corner(k + 1) - triangle.corner(k));
    change += side.x * reach.y + side.y * reach.x;
  }
  return change;
}

/// Completes the reach; false where neither the rules nor a device can show the triangle.
bool complete(DeviceTriangle& triangle) {
  const auto& [a, b, c] = triangle.reaches;
  triangle.reach = glm::max(a, glm::max(b, c));
  const double change = largestChangeOfArea(triangle);
  triangle.mayFlip = change > 0 && static_cast<double>(std::abs(triangle.area)) <= change;
  return triangle.area != 0 || change > 0;
}

/// Whether a plane of z in clip space cuts off a corner.
bool leavesDepthRange(const raster::DrawList& list, const std::array<ViewVertex, 3>& corners) {
  using enum raster::ClipPlane;
  const auto planes = raster::clipPlanes(list.clipDepth);
  return std::any_of(planes.begin(), planes.end(), [&](raster::ClipPlane plane) {
    const bool isOfZ = plane == ZeroZ || plane == LeastZ || plane == LargestZ;
    return isOfZ && raster::cuts(plane, corners, 0);
  });
}

/// Whether the triangle is inside the view for all errors of its vertices. A device may clip any other triangle
/// anywhere between the view and the guard band.
bool staysInView(const std::array<ViewVertex, 3>& corners, const std::array<ViewVertex, 3>& sizes, double nearDistance,
                 double roundoff) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double pictureError = roundoff * sizes[k].u;
    const double minDepth = corners[k].w - roundoff * sizes[k].v;
    if (minDepth < nearDistance) return false;
    if (std::max(std::abs(corners[k].x), std::abs(corners[k].y)) + pictureError > minDepth) return false;
  }
  return true;
}

/// A triangle after clipping, and the same polygon with its sums of sizes in place of texture coordinates.
struct Clipped {
  raster::ClippedPolygon polygon;
  raster::ClippedPolygon sizes;
  bool isLoose;        ///< it leaves the view, and a device may clip it at other planes
  glm::dvec2 largest;  ///< of |u| and |v|
};

/// Empty polygons if clipping leaves nothing, or if a value is not finite.
Clipped clipTriangle(const raster::DrawList& list, const raster::Face& face, std::uint32_t t, bool loose,
                     double roundoff) {
  const std::array<ViewVertex, 3> corners = raster::view(face, list, t);
  if (!raster::areFinite(corners)) return {};
  std::array<ViewVertex, 3> sizes;
  for (std::size_t k = 0; k < 3; ++k)
    sizes[k] = withSizes(corners[k], list, face, list.indices[3 * std::size_t{t} + k]);
  glm::dvec2 largest(0.0);
  for (const ViewVertex& corner : corners) largest = glm::max(largest, glm::abs(glm::dvec2(corner.u, corner.v)));
  const double nearDistance = face.nearDistance;
  const auto clipped = [&](const std::array<ViewVertex, 3>& triangle, double smallest) {
    return raster::clip(triangle, smallest, list.clipDepth);
  };
  if (!loose || (staysInView(corners, sizes, nearDistance, roundoff) && !leavesDepthRange(list, corners)))
    return {clipped(corners, nearDistance), clipped(sizes, nearDistance), false, largest};

  const double picture = std::max({sizes[0].u, sizes[1].u, sizes[2].u});
  const double depth = std::max({sizes[0].v, sizes[1].v, sizes[2].v});
  for (ViewVertex& corner : sizes) {
    corner.u = picture;
    corner.v = depth;
  }
  const double looseNear = std::max(nearDistance / 2, nearDistance - roundoff * depth);
  return {clipped(corners, looseNear), clipped(sizes, looseNear), true, largest};
}

/// Triangle (0, k - 1, k) of the fan of a polygon.
DeviceTriangle fanTriangle(const raster::DrawList& list, const raster::Face& face, const Clipped& clipped,
                           std::size_t k, const Placement& placement) {
  const std::array<ViewVertex, 3> fan = raster::fanTriangle(clipped.polygon, k);
  const std::array<ViewVertex, 3> sizes = raster::fanTriangle(clipped.sizes, k);
  std::array<raster::SnappedPoint, 3> corners;
  for (std::size_t j = 0; j < 3; ++j) corners[j] = raster::snap(face, fan[j]);
  DeviceTriangle triangle{raster::snappedTriangle(list, face, fan, corners)};
  for (std::size_t j = 0; j < 3; ++j) {
    triangle.reaches[j] = placement.reach(fan[j], sizes[j], clipped.isLoose);
    triangle.depthSlack = std::max(triangle.depthSlack, placement.depthSlack(sizes[j]));
  }
  triangle.largest = clipped.largest;
  triangle.nearestDepth = HUGE_VAL;
  for (const ViewVertex& vertex : clipped.polygon) triangle.nearestDepth = std::min(triangle.nearestDepth, vertex.w);
  return triangle;
}

// --- the sample's box ---

/// A point of a triangle on the screen; 1/w, u/w, v/w and z/w are linear there.
struct Point {
  glm::dvec2 position;
  glm::dvec4 overW;  ///< 1/w, u/w, v/w, -z/w
};

/// A triangle cut by the four sides of a box. Each side adds a corner to a convex polygon. Rounding can make the
/// polygon slightly non-convex; then a side multiplies the number of corners by at most 3/2: 3, 4, 6, 9, 13.
using Polygon = boost::container::static_vector<Point, 13>;

/// Clips to sign * position[axis] <= sign * bound.
Polygon cut(const Polygon& polygon, int axis, double sign, double bound) {
  Polygon result;
  const auto inside = [=](const Point& point) { return sign * (bound - point.position[axis]); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const double atP = inside(p), atQ = inside(q);
    if (atP >= 0) result.push_back(p);
    if ((atP >= 0) != (atQ >= 0)) {
      const double t = atP / (atP - atQ);
      result.push_back({p.position + t * (q.position - p.position), p.overW + t * (q.overW - p.overW)});
    }
  }
  return result;
}

/// The edge function of the edge from vertex k to the next, positive inside, and whether the edge is top or left.
struct EdgeValue {
  double value;
  bool inclusive;
};

EdgeValue edgeAt(const DeviceTriangle& triangle, std::size_t k, const glm::dvec2& sample) {
  const raster::SnappedPoint direction = directionOf(triangle, (k + 2) % 3);
  return {raster::cross(glm::dvec2(direction.x, direction.y), sample - triangle.corner(k)),
          raster::ownsSamples(direction)};
}

glm::dvec2 edgeReach(const DeviceTriangle& triangle, std::size_t k) {
  return glm::max(triangle.reaches[k], triangle.reaches[(k + 1) % 3]);
}

/// Whether the sample is outside of an edge without reach.
bool isOutsideFixedEdge(const DeviceTriangle& triangle, const glm::dvec2& sample, EdgeRule rule) {
  if (triangle.mayFlip) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeValue edge = edgeAt(triangle, k, sample);
    const bool covers = edge.value > 0 || (edge.value == 0 && (edge.inclusive || rule == EdgeRule::Any));
    if (edgeReach(triangle, k) == glm::dvec2(0.0) && !covers) return true;
  }
  return false;
}

/// Whether the box of half-widths `reach` about the sample lies on the outer side of an edge: an early exit.
bool isBeyondEdge(const DeviceTriangle& triangle, const glm::dvec2& sample, const glm::dvec2& reach) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 along = glm::abs(triangle.corner(k + 1) - triangle.corner(k));
    if (edgeAt(triangle, k, sample).value < -(along.x * reach.y + along.y * reach.x)) return true;
  }
  return false;
}

}  // namespace

std::vector<DeviceTriangle> placeTriangles(const raster::DrawList& list, const raster::Face& face,
                                           const DeviceProfile& profile, bool loose,
                                           const std::function<bool(const DeviceTriangle&)>& isWanted) {
  const raster::Viewport viewport = raster::viewportOf(face);
  const Placement placement{profile, {viewport.columns, viewport.rows}, profile.vertexError * 0x1p-24};
  std::vector<DeviceTriangle> triangles;
  for (const DrawnTriangle& drawn : drawnTriangles(list)) {
    const Clipped clipped = clipTriangle(list, face, drawn.triangle, loose, placement.roundoff);
    for (std::size_t k = 2; k < clipped.polygon.count; ++k) {
      DeviceTriangle triangle = fanTriangle(list, face, clipped, k, placement);
      triangle.number = drawn.triangle;
      triangle.draw = drawn.draw;
      if (complete(triangle) && isWanted(triangle)) triangles.push_back(triangle);
    }
  }
  return triangles;
}

std::optional<Region> regionAt(const DeviceTriangle& triangle, const glm::dvec2& sample, EdgeRule rule) {
  // Without reach the box is a point; the pad keeps it when rounding moves corners of the polygon.
  constexpr double pad = 0x1p-16;
  const Extent extent = extentOf(triangle);
  for (int axis = 0; axis < 2; ++axis) {
    const double reach = triangle.reach[axis] + pad;
    if (extent.low[axis] > sample[axis] + reach || extent.high[axis] < sample[axis] - reach) return {};
  }
  if (isOutsideFixedEdge(triangle, sample, rule) || isBeyondEdge(triangle, sample, triangle.reach + 2 * pad)) return {};
  Polygon polygon;
  for (std::size_t k = 0; k < 3; ++k) {
    const ViewVertex& vertex = triangle.vertices[k];
    polygon.push_back({triangle.corner(k), glm::dvec4(1, vertex.u, vertex.v, -vertex.z) / vertex.w});
  }
  for (int axis = 0; axis < 2; ++axis)
    for (const double sign : {1.0, -1.0})
      polygon = cut(polygon, axis, sign, sample[axis] + sign * (triangle.reach[axis] + pad));
  if (polygon.empty()) return {};

  const glm::dvec4& start = polygon[0].overW;
  const glm::dvec2 texture = glm::dvec2(start.y, start.z) / start.x;
  Region region{start.w, start.w, start.x, texture, texture};
  for (const Point& point : polygon) {
    const glm::dvec4& overW = point.overW;
    const glm::dvec2 coordinates = glm::dvec2(overW.y, overW.z) / overW.x;
    region.nearest = std::max(region.nearest, overW.w);
    region.farthest = std::min(region.farthest, overW.w);
    region.leastInverse = std::min(region.leastInverse, overW.x);
    region.low = glm::min(region.low, coordinates);
    region.high = glm::max(region.high, coordinates);
  }
  return region;
}

bool edgeMayPass(const DeviceTriangle& triangle, std::size_t k, const glm::dvec2& sample, EdgeRule rule) {
  const glm::dvec2 p = triangle.corner(k), q = triangle.corner(k + 1), reach = edgeReach(triangle, k);
  if (reach == glm::dvec2(0.0) && rule == EdgeRule::TopLeft) return false;
  for (int axis = 0; axis < 2; ++axis)
    if (std::min(p[axis], q[axis]) > sample[axis] + reach[axis] ||
        std::max(p[axis], q[axis]) < sample[axis] - reach[axis])
      return false;
  // The value is exact from either end, so that two triangles that share the edge get equal results.
  const glm::dvec2 along = q - p;
  return std::abs(raster::cross(along, sample - p)) <= std::abs(along.x) * reach.y + std::abs(along.y) * reach.x;
}

}  // namespace hemitex::reference
