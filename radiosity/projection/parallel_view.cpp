#include "radiosity/projection/parallel_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "radiosity/projection/patch_view.h"
#include "raster/culling/frustum_culling.h"

namespace hemitex::radiosity {
namespace {

/// Point i of a sequence that fills the unit square evenly for any count, minus its centre: a lattice with the powers
/// of the plastic number (Roberts 2018).
glm::dvec2 shiftOf(std::uint32_t i) {
  constexpr double plastic = 1.32471795724474602596;
  const glm::dvec2 steps = static_cast<double>(i) * glm::dvec2(1 / plastic, 1 / (plastic * plastic)) + 0.5;
  return steps - glm::floor(steps) - 0.5;
}

/// The pixels of a face that may show something inside a box, at least one.
raster::Scissor partWith(const SpaceBox& box, const glm::dvec3& origin, const raster::Face& face) {
  // Positions are drawn in binary32. Rounding is monotonic, so that the rounded box holds the rounded positions.
  const glm::vec3 low(box.low - origin), high(box.high - origin);
  const raster::Scissor part = raster::ViewBounds(face).placeOf({low, high}).part;
  const int last = face.resolution - 1;
  return {std::min(part.column, last), std::min(part.row, last), std::max(part.width, 1), std::max(part.height, 1)};
}

}  // namespace

BoundingSphere boundingSphere(const Scene& scene) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec3& corner : triangle.position) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
  return {0.5 * (low + high), 0.5 * glm::length(high - low), {low, high}};
}

raster::Face ParallelViews::face(const glm::dvec3& origin, const glm::dvec3& towards, std::uint32_t number) const {
  const double distance = farDistance * bounds.radius;
  // The picture plane passes through the centre of the scene, where w = 1.
  const glm::dvec3 w = -towards / distance;
  const glm::dvec3 up = upOf(Orientation::Turned, towards, number, 0), right = glm::cross(up, towards);
  const glm::dvec2 shift = shiftOf(number) * (2.0 / resolution);
  const double halfWidth = 0.5 * resolution * pixelSide();
  raster::Face face;
  face.eye = bounds.centre + distance * towards - origin;
  face.x = right / (glm::length(right) * halfWidth) + shift.x * w;
  face.y = up / (glm::length(up) * halfWidth) + shift.y * w;
  face.w = w;
  face.nearDistance = 0.5F;
  face.resolution = resolution;
  face.scissor = {0, 0, resolution, resolution};
  face.scissor = partWith(bounds.box, origin, face);
  return face;
}

Projection ParallelViews::pixelCounts() const {
  const auto side = static_cast<std::size_t>(resolution);
  Projection projection;
  projection.faces.resize(1);
  projection.faces.front().resolution = resolution;
  projection.faces.front().scissor = {0, 0, resolution, resolution};
  projection.sharesBefore.emplace_back(side * side + 1);
  std::iota(projection.sharesBefore.front().begin(), projection.sharesBefore.front().end(), std::uint64_t{0});
  projection.captured = projection.sharesBefore.front().back();
  return projection;
}

std::vector<glm::dvec3> sphereDirections(int count) {
  // Each point is rotated against the one before by the golden angle, pi (3 - sqrt(5)). A product with constants
  // replaces sines, whose last digits differ between machines.
  constexpr double cosine = -0.7373688780783197, sine = 0.6754902942615238;
  std::vector<glm::dvec3> directions(static_cast<std::size_t>(count));
  glm::dvec2 around(1, 0);
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count;
    const glm::dvec2 xy = around * std::sqrt(1 - z * z);
    directions[static_cast<std::size_t>(i)] = {xy, z};
    around = {around.x * cosine - around.y * sine, around.x * sine + around.y * cosine};
  }
  return directions;
}

}  // namespace hemitex::radiosity
