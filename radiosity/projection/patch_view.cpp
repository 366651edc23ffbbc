#include "radiosity/projection/patch_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "radiosity/geometry/tangent_along.h"
#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {
namespace {

/// Maximum number of triangles per box. Larger runs have large boxes; smaller runs are too many.
constexpr std::uint32_t maxTriangles = 32;

SpaceBox boxAround(const Scene& scene, const TriangleRange& range) {
  const double infinity = std::numeric_limits<double>::infinity();
  SpaceBox box{glm::dvec3(infinity), glm::dvec3(-infinity)};
  for (std::uint32_t t = range.first; t < range.end; ++t)
    for (const glm::dvec3& corner : placedCorners(scene, {range.instance, range.surface, t})) {
      box.low = glm::min(box.low, corner);
      box.high = glm::max(box.high, corner);
    }
  return box;
}

/// The direction at right angles to a normal at a share of a quarter turn from the first axis. It uses rational points
/// of the circle, because a sine would differ between machines. The spacing is not quite uniform, which is sufficient.
glm::dvec3 quarterTurn(const glm::dvec3& normal, double share) {
  const glm::dvec3 x = tangentAlong(normal, glm::dvec3(0)), y = glm::cross(normal, x);
  return (1 - share * share) * x + 2 * share * y;
}

/// The squared distance from a point to a triangle: to the plane if the point projects inside, else to an edge.
double squaredDistance(const glm::dvec3& point, const std::array<glm::dvec3, 3>& corner) {
  const glm::dvec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& a = corner[k];
    const glm::dvec3 edge = corner[(k + 1) % 3] - a;
    inside &= glm::dot(glm::cross(n, edge), point - a) >= 0;
    const double t = std::clamp(glm::dot(point - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
    const glm::dvec3 offset = point - (a + t * edge);
    nearest = std::min(nearest, glm::dot(offset, offset));
  }
  const double height = glm::dot(n, point - corner[0]);
  return inside ? height * height / glm::dot(n, n) : nearest;
}

/// The squared distance from a point to the box around a triangle: a cheap lower bound.
double squaredDistanceToBounds(const glm::dvec3& point, const std::array<glm::dvec3, 3>& corner) {
  return squaredDistance(point, SpaceBox{glm::min(glm::min(corner[0], corner[1]), corner[2]),
                                         glm::max(glm::max(corner[0], corner[1]), corner[2])});
}

/// Height above the tangent plane.
double heightOf(const glm::dvec3& position, const SurfacePoint& point) {
  return glm::dot(position - point.position, point.normal);
}

/// The lowest and the highest value of heightOf in a box. The bounds hold in double precision, because all operations
/// of heightOf are monotonic, including their rounding.
std::pair<double, double> heightsOf(const SpaceBox& box, const SurfacePoint& point) {
  const auto isUp = glm::greaterThan(point.normal, glm::dvec3(0));
  return {heightOf(glm::mix(box.high, box.low, isUp), point), heightOf(glm::mix(box.low, box.high, isUp), point)};
}

bool liesInPlane(const std::array<glm::dvec3, 3>& corners, const SurfacePoint& point, double tolerance) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](const glm::dvec3& corner) { return std::abs(heightOf(corner, point)) <= tolerance; });
}

bool facesAway(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& eye) {
  return glm::dot(eye - corners[0], glm::cross(corners[1] - corners[0], corners[2] - corners[0])) < 0;
}

}  // namespace

TriangleBoxes triangleBoxes(const Scene& scene) {
  std::vector<TriangleRange> ranges;
  std::vector<SpaceBox> boxes;
  std::vector<std::uint32_t> firstRange, backed;
  std::uint32_t number = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      const auto count = static_cast<std::uint32_t>(scene.surfaces[s].triangles.size());
      if (hasBacked(scene.surfaces[s])) backed.push_back(static_cast<std::uint32_t>(firstRange.size()));
      firstRange.push_back(static_cast<std::uint32_t>(ranges.size()));
      for (std::uint32_t first = 0; first < count; first += maxTriangles) {
        ranges.push_back({i, s, first, std::min(first + maxTriangles, count), number + first});
        boxes.push_back(boxAround(scene, ranges.back()));
      }
      number += count;
    }
  firstRange.push_back(static_cast<std::uint32_t>(ranges.size()));
  NearestBoxes nearest(boxes);
  return {std::move(ranges), std::move(boxes), std::move(firstRange), std::move(backed), std::move(nearest)};
}

std::vector<std::uint32_t> skippedTriangles(const Scene& scene, const TriangleBoxes& boxes, std::uint32_t surface,
                                            const SurfacePoint& point) {
  const double tolerance = tangentPlaneTolerance * scene.extent;
  std::vector<std::uint32_t> skipped;
  const auto append = [&](std::uint32_t number, bool hasBacked) {
    const Surface& seen = scene.surfaces[number % scene.surfaces.size()];
    const bool isOwn = number == surface || (number < scene.surfaces.size() && seen.twin == static_cast<int>(surface));
    for (std::uint32_t r = boxes.firstRange[number]; r < boxes.firstRange[number + 1]; ++r) {
      const auto [lowest, highest] = heightsOf(boxes.boxes[r], point);
      const bool mayLie = isOwn && lowest <= tolerance && highest >= -tolerance;
      const bool allLie = mayLie && lowest >= -tolerance && highest <= tolerance;
      if (!mayLie && !hasBacked) continue;
      const TriangleRange& range = boxes.ranges[r];
      for (std::uint32_t t = range.first; t < range.end; ++t) {
        const std::array<glm::dvec3, 3> corners = placedCorners(scene, {range.instance, range.surface, t});
        if (allLie || (mayLie && liesInPlane(corners, point, tolerance)) ||
            (seen.triangles[t].isBacked && facesAway(corners, point.position)))
          skipped.push_back(range.number + (t - range.first));
      }
    }
  };
  // A surface with a twin is one of `backed`, and so is its twin.
  if (surface != noSurface && !std::binary_search(boxes.backed.begin(), boxes.backed.end(), surface))
    append(surface, false);
  const auto ownEnd = static_cast<std::ptrdiff_t>(skipped.size());
  for (const std::uint32_t backed : boxes.backed) append(backed, true);
  std::inplace_merge(skipped.begin(), skipped.begin() + ownEnd, skipped.end());
  return skipped;
}

double nearDistance(const Scene& scene, const TriangleBoxes& boxes, const glm::dvec3& point,
                    const std::vector<std::uint32_t>& skipped, double squaredReach) {
  double nearest = std::numeric_limits<double>::infinity();
  boxes.nearest.visit(point, nearest, [&](std::uint32_t number, double& limit) {
    if (squaredDistance(point, boxes.boxes[number]) >= limit) return;
    const TriangleRange& range = boxes.ranges[number];
    auto skip = std::lower_bound(skipped.begin(), skipped.end(), range.number);
    for (std::uint32_t t = range.first; t < range.end; ++t) {
      const std::array<glm::dvec3, 3> corner = placedCorners(scene, {range.instance, range.surface, t});
      if (skip != skipped.end() && *skip == range.number + (t - range.first))
        ++skip;
      else if (squaredDistanceToBounds(point, corner) < limit)
        limit = std::min(limit, squaredDistance(point, corner));
    }
  });
  return std::clamp(std::sqrt(nearest / squaredReach), smallestNearDistance * scene.extent, scene.extent);
}

double turnOf(std::uint32_t patch, int point) {
  // The golden section and its square, in units of 2^-32; the product wraps around to the fraction.
  const std::uint32_t turn = patch * 0x9e3779b9U + static_cast<std::uint32_t>(point) * 0x61c88647U;
  return turn * 0x1p-32;
}

std::vector<std::uint32_t> trianglesFacingAway(const Scene& scene, const glm::dvec3& eye, bool onlyBacked) {
  std::vector<std::uint32_t> away;
  std::uint32_t number = 0;
  forEachPlace(scene, [&](const TrianglePlace& place) {
    if ((scene.surfaces[place.surface].triangles[place.triangle].isBacked || !onlyBacked) &&
        facesAway(placedCorners(scene, place), eye))
      away.push_back(number);
    ++number;
  });
  return away;
}

glm::dvec3 upOf(Orientation orientation, const glm::dvec3& normal, std::uint32_t patch, int point) {
  return orientation == Orientation::Aligned ? glm::dvec3(0) : quarterTurn(normal, turnOf(patch, point));
}

}  // namespace hemitex::radiosity
