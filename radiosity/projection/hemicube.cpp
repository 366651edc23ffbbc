#include "radiosity/projection/hemicube.h"

#include <cassert>
#include <numeric>

#include "radiosity/projection/delta_form_factors.h"

namespace hemitex::radiosity {
namespace {

// cos(theta) / pi per area of the cube (Cohen and Greenberg 1985). With s the distance to the point on the cube,
// cos(theta) is 1/s on the top face and z/s on a side. The foreshortening is 1/s, and solid angle falls with 1/s^2.
double topDensity(double x, double y) {
  const double s2 = x * x + y * y + 1;
  return 1 / (pi * s2 * s2);
}
double sideDensity(double x, double z) {
  const double s2 = x * x + z * z + 1;
  return z / (pi * s2 * s2);
}

/// Adds the rounding error of the sum (four quadrants of the top and eight halves of sides) to the quadrant, evenly.
void closeSum(std::vector<std::uint64_t>& top, const std::vector<std::uint64_t>& side) {
  const std::uint64_t sum = std::accumulate(top.begin(), top.end(), std::uint64_t{0}) +
                            2 * std::accumulate(side.begin(), side.end(), std::uint64_t{0});
  spread(top, static_cast<std::int64_t>(wholeShare / 4 - sum));
}

}  // namespace

std::vector<ProjectionFace> hemicubeFaces(int resolution) {
  assert(resolution >= 2 && resolution <= 4096 && resolution % 2 == 0);
  const raster::Scissor whole{0, 0, resolution, resolution};
  const raster::Scissor aboveHorizon{0, resolution / 2, resolution, resolution / 2};
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), normal(0, 0, 1);
  return {{x, y, normal, resolution, whole, 0},
          {y, normal, x, resolution, aboveHorizon, 1},
          {-x, normal, y, resolution, aboveHorizon, 1},
          {-y, normal, -x, resolution, aboveHorizon, 1},
          {x, normal, -y, resolution, aboveHorizon, 1}};
}

Projection hemicube(int resolution) {
  const int half = resolution / 2;
  std::vector<std::uint64_t> quadrant = pixelShares(half, 1, topDensity);
  const std::vector<std::uint64_t> halfSide = pixelShares(half, 1, sideDensity);
  closeSum(quadrant, halfSide);
  // By symmetry these are enough: a side is the second half of a square, from the horizon on.
  std::vector<std::uint64_t> side = mirroredQuadrant(halfSide, half);
  side.erase(side.begin(), side.begin() + static_cast<std::ptrdiff_t>(side.size() / 2));
  return {hemicubeFaces(resolution),
          {runningSums(mirroredQuadrant(quadrant, half)), runningSums(side)},
          wholeShare,
          hemicubeSquaredReach};
}

}  // namespace hemitex::radiosity
