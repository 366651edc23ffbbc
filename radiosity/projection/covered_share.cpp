#include "radiosity/projection/covered_share.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace hemitex::radiosity {
namespace {

/// A convex polygon of at most four corners: a triangle clipped by a plane.
struct ClippedTriangle {
  std::array<glm::dvec3, 4> corners;
  std::size_t count = 0;
};

/// The triangle in the coordinates of a face, with w in z, clipped at the near distance. Empty if the triangle lies
/// behind that distance or completely beside one side of the viewport.
ClippedTriangle clippedBy(const raster::Face& face, const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 eye(face.eye), x(face.x), y(face.y), w(face.w);
  const double near = face.nearDistance;
  std::array<glm::dvec3, 3> seen;
  const auto all = [&](const auto& isOutside) {
    return isOutside(seen[0]) && isOutside(seen[1]) && isOutside(seen[2]);
  };
  for (std::size_t k = 0; k < 3; ++k) seen[k].z = glm::dot(w, corners[k] - eye);
  if (all([&](const glm::dvec3& c) { return c.z < near; })) return {};
  for (std::size_t k = 0; k < 3; ++k) seen[k].x = glm::dot(x, corners[k] - eye);
  if (all([](const glm::dvec3& c) { return c.x > c.z; }) || all([](const glm::dvec3& c) { return c.x < -c.z; }))
    return {};
  for (std::size_t k = 0; k < 3; ++k) seen[k].y = glm::dot(y, corners[k] - eye);
  if (all([](const glm::dvec3& c) { return c.y > c.z; }) || all([](const glm::dvec3& c) { return c.y < -c.z; }))
    return {};
  ClippedTriangle clipped;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &a = seen[k], &b = seen[(k + 1) % 3];
    if (a.z >= near) clipped.corners[clipped.count++] = a;
    if ((a.z >= near) != (b.z >= near)) clipped.corners[clipped.count++] = a + (near - a.z) / (b.z - a.z) * (b - a);
  }
  return clipped;
}

/// An edge as a line x = start + slope y over the rows whose centres it crosses.
struct EdgeLine {
  double low, high;  ///< y of its ends
  double start, slope;
};

/// The first integer i of [first, end] with i + 1/2 >= x.
int firstCentre(double x, int first, int end) {
  const double clamped = std::clamp(x - 0.5, static_cast<double>(first), static_cast<double>(end));  // at least 0
  const int whole = static_cast<int>(clamped);
  return clamped > whole ? whole + 1 : whole;
}

/// The share of the pixels of one face whose centres are in a polygon.
std::uint64_t shareOn(const raster::Face& face, const std::vector<std::uint64_t>& before,
                      const ClippedTriangle& polygon) {
  std::array<glm::dvec2, 4> corners;  // in pixels
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const glm::dvec3& corner = polygon.corners[k];
    corners[k] = (glm::dvec2(corner) / corner.z + 1.0) * (0.5 * face.resolution);
  }
  std::array<EdgeLine, 4> edges;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const glm::dvec2 &a = corners[k], &b = corners[(k + 1) % polygon.count];
    const double slope = a.y == b.y ? 0.0 : (b.x - a.x) / (b.y - a.y);
    edges[k] = {std::min(a.y, b.y), std::max(a.y, b.y), a.x - slope * a.y, slope};
    low = std::min(low, a.y);
    high = std::max(high, a.y);
  }
  const raster::Scissor& scissor = face.scissor;
  const int columnEnd = scissor.column + scissor.width, rowEnd = scissor.row + scissor.height;
  std::uint64_t sum = 0;
  const int end = firstCentre(high, scissor.row, rowEnd);
  for (int row = firstCentre(low, scissor.row, rowEnd); row < end; ++row) {
    const double y = row + 0.5;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t k = 0; k < polygon.count; ++k) {
      if (!(edges[k].low <= y && y < edges[k].high)) continue;
      const double x = edges[k].start + edges[k].slope * y;
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (!(left < right)) continue;
    const auto offset = static_cast<std::ptrdiff_t>(row - scissor.row) * scissor.width - scissor.column;
    const auto sharesUpTo = [&](double x) {
      return before[static_cast<std::size_t>(offset + firstCentre(x, scissor.column, columnEnd))];
    };
    sum += sharesUpTo(right) - sharesUpTo(left);
  }
  return sum;
}

}  // namespace

double coveredShare(const Projection& projection, std::span<const raster::Face> faces,
                    const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (glm::dot(normal, glm::dvec3(faces.front().eye) - corners[0]) <= 0) return 0;
  std::uint64_t sum = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const ClippedTriangle polygon = clippedBy(faces[f], corners);
    if (polygon.count >= 3) sum += shareOn(faces[f], projection.sharesBefore[projection.faces[f].shares], polygon);
  }
  return formFactor(sum);
}

}  // namespace hemitex::radiosity
