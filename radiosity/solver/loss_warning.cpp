#include "radiosity/solver/loss_warning.h"

#include <algorithm>
#include <vector>

#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

/// Limit for a warning, as a share of the emitted flux.
constexpr double maxLost = 0.99;

/// A surface is far if it is this many times as far from the middle as half of the surfaces.
constexpr double farRatio = 1000;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The middle of the surfaces: the median of their first corners, per axis. A few far surfaces do not move it.
glm::dvec3 middleOf(const Scene& scene) {
  glm::dvec3 middle(0);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for (const Surface& surface : scene.surfaces)
      coordinates.push_back(surface.triangles.front().position.front()[axis]);
    middle[axis] = median(std::move(coordinates));
  }
  return middle;
}

/// The distances of the surfaces from a point, each at its farthest corner.
std::vector<double> distancesFrom(const glm::dvec3& point, const Scene& scene) {
  std::vector<double> distances;
  for (const Surface& surface : scene.surfaces) {
    double farthest = 0;
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec3& corner : triangle.position) farthest = std::max(farthest, glm::length(corner - point));
    distances.push_back(farthest);
  }
  return distances;
}

/// What is too far away, and what to do about it.
std::string reasonOf(const Scene& scene) {
  const std::vector<double> distances = distancesFrom(middleOf(scene), scene);
  const double usual = median(distances);
  const auto farthest = std::max_element(distances.begin(), distances.end());
  if (!(*farthest > farRatio * usual))
    return "The lit surfaces see few others: turn faces over if their lit sides look outwards";
  const Surface& surface = scene.surfaces[static_cast<std::size_t>(farthest - distances.begin())];
  return "The surface `" + raster::excerpt(surface.name) + "` is " + raster::shortNumber(*farthest) +
         " units from the middle of the scene, half of whose surfaces are within " + raster::shortNumber(usual) +
         " units: the others are too small beside it. Remove it or move it nearer";
}

}  // namespace

std::optional<std::string> lossWarning(const Scene& scene, const Energy& energy) {
  const double emitted = bandSum(energy.emitted), left = bandSum(energy.lost) - bandSum(energy.lostToBacks);
  if (!(emitted > 0 && left > maxLost * emitted)) return std::nullopt;
  return raster::shortNumber(100 * left / emitted) + " % of the emitted flux left the scene. " + reasonOf(scene);
}

}  // namespace hemitex::radiosity
