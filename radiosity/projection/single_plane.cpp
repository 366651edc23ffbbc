#include "radiosity/projection/single_plane.h"

#include <cassert>
#include <numeric>

#include "radiosity/projection/delta_form_factors.h"

namespace hemitex::radiosity {
namespace {

/// cos(theta) / pi per area of a plane at distance 1, as on the top of a hemicube.
double density(double x, double y) {
  const double s2 = x * x + y * y + 1;
  return 1 / (pi * s2 * s2);
}

}  // namespace

Projection singlePlane(int resolution, double halfWidth) {
  assert(resolution >= 2 && resolution <= 4096 && resolution % 2 == 0);
  assert(halfWidth > 0 && halfWidth <= 64);
  const int half = resolution / 2;
  const std::vector<std::uint64_t> quadrant = pixelShares(half, halfWidth, density);
  const ProjectionFace face{
      {1 / halfWidth, 0, 0}, {0, 1 / halfWidth, 0}, {0, 0, 1}, resolution, {0, 0, resolution, resolution}, 0};
  const std::uint64_t captured = 4 * std::accumulate(quadrant.begin(), quadrant.end(), std::uint64_t{0});
  return {{face}, {runningSums(mirroredQuadrant(quadrant, half))}, captured, 1 + 2 * halfWidth * halfWidth};
}

}  // namespace hemitex::radiosity
