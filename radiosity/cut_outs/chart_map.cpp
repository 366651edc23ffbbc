#include "radiosity/cut_outs/chart_map.h"

#include <algorithm>
#include <cmath>

namespace hemitex::radiosity {
namespace {

double chartArea(const Triangle& triangle) {
  return std::abs(raster::cross(triangle.chart[1] - triangle.chart[0], triangle.chart[2] - triangle.chart[0])) / 2;
}

const Triangle& largestInChart(const Surface& surface) {
  return *std::max_element(surface.triangles.begin(), surface.triangles.end(),
                           [](const Triangle& a, const Triangle& b) { return chartArea(a) < chartArea(b); });
}

/// Whether a predicate holds for each corner of each triangle.
template <typename Predicate>
bool holdsAtCorners(const Surface& surface, const Predicate& holds) {
  return std::all_of(surface.triangles.begin(), surface.triangles.end(), [&](const Triangle& triangle) {
    return holds(triangle, 0) && holds(triangle, 1) && holds(triangle, 2);
  });
}

}  // namespace

std::optional<AffineMap<glm::dvec2>> textureMap(const Surface& surface, const Sampler& sampler,
                                                const glm::dvec2& size) {
  constexpr double unit = 0x1p-20, tolerance = 0x1p-6;
  const Triangle& largest = largestInChart(surface);
  AffineMap<glm::dvec2> map(largest.chart, largest.texcoord);
  for (glm::dvec2* value : {&map.alongU, &map.alongV, &map.origin}) *value = glm::round(*value / unit) * unit;
  const bool isOne = holdsAtCorners(surface, [&](const Triangle& triangle, std::size_t k) {
    const glm::dvec2 off = (sampler(map(triangle.chart[k])) - sampler(triangle.texcoord[k])) * size;
    return std::max(std::abs(off.x), std::abs(off.y)) <= tolerance;
  });
  if (!isOne) return std::nullopt;
  return map;
}

bool isWholeParallelogram(const Surface& surface) {
  constexpr double tolerance = 0x1p-15;
  const Triangle& largest = largestInChart(surface);
  const AffineMap<glm::dvec3> map(largest.chart, largest.position);
  double covered = 0;
  for (const Triangle& triangle : surface.triangles) covered += chartArea(triangle);
  const double farthest = tolerance * std::min(glm::length(map.alongU), glm::length(map.alongV));
  return covered >= 1 - tolerance && holdsAtCorners(surface, [&](const Triangle& triangle, std::size_t k) {
           return glm::distance(map(triangle.chart[k]), triangle.position[k]) <= farthest;
         });
}

}  // namespace hemitex::radiosity
