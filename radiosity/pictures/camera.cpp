#include "radiosity/pictures/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

constexpr int largestSide = 4096;
/// In degrees; with smaller angles, magnified coordinates would exceed binary32.
constexpr double smallestFieldOfView = 1e-6;

/// The distance of the middle of a scissor rectangle from that of the viewport, in units of x/w.
double offCentre(int first, int size, int resolution) { return (2.0 * first + size) / resolution - 1; }

/// Lambert's continued fraction, tan x = x / (1 - x^2 / (3 - x^2 / (5 - ...))), for x in [0, pi/4]. The error of
/// stopping at level k is about (x/2)^(2k) / k!^2, which is negligible for k = 10.
double tangentOfSmall(double x) {
  double denominator = 21;
  for (int odd = 19; odd >= 1; odd -= 2) denominator = odd - x * x / denominator;
  return x / denominator;
}

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

}  // namespace

double tangentOfDegrees(double degrees) {
  assert(degrees >= 0 && degrees < 90);
  return degrees <= 45 ? tangentOfSmall(radians(degrees)) : 1 / tangentOfSmall(radians(90 - degrees));
}

CameraAxes axesOf(const Camera& camera) {
  const glm::dvec3 direction = camera.lookAt - camera.eye;
  const double distance = glm::length(direction);
  if (!(distance > 0 && std::isfinite(distance)))
    throw raster::InputError("the camera has no direction", "let it look at a point other than its eye");
  const glm::dvec3 forward = direction / distance;
  const glm::dvec3 sideways = glm::cross(forward, camera.up / glm::length(camera.up));
  if (!(glm::length(sideways) > 1e-9))
    throw raster::InputError("the camera's up vector is zero or lies along its direction", "choose another up vector");
  const glm::dvec3 right = glm::normalize(sideways);
  return {right, glm::cross(right, forward), forward};
}

/// On the plane w = 1 the picture is 2 tan(fov/2) high, so that the side of a pixel is 2 tan(fov/2) / height. The
/// viewport's side of 2 has `resolution` pixels. This gives the scale of the rows. The picture lies in the middle of
/// the viewport. If the difference of their sizes is odd, shearing corrects the half pixel: X + s W moves x/w by s
/// everywhere.
raster::Face cameraFace(const Scene& scene, const Camera& camera, int width, int height) {
  if (std::min(width, height) < 1 || std::max(width, height) > largestSide)
    throw raster::InputError("a picture of " + std::to_string(width) + " x " + std::to_string(height) + " samples",
                             "choose sides from 1 to " + std::to_string(largestSide));
  if (!(camera.fov >= smallestFieldOfView && camera.fov < 180))
    throw raster::InputError("the field of view must lie between 1e-6 and 180 degrees");
  const CameraAxes axes = axesOf(camera);
  const int resolution = (std::max(width, height) + 1) / 2 * 2;
  const double scale = height / (tangentOfDegrees(camera.fov / 2) * resolution);

  raster::Face face;
  face.scissor = {(resolution - width) / 2, (resolution - height) / 2, width, height};
  face.resolution = resolution;
  face.eye = glm::vec3(camera.eye - scene.origin);
  face.x = glm::vec3(scale * axes.right + offCentre(face.scissor.column, width, resolution) * axes.forward);
  face.y = glm::vec3(scale * axes.up + offCentre(face.scissor.row, height, resolution) * axes.forward);
  face.w = glm::vec3(axes.forward);
  face.nearDistance = std::max(static_cast<float>(1e-5 * scene.extent), std::numeric_limits<float>::min());
  raster::validate(face);
  return face;
}

}  // namespace hemitex::radiosity
