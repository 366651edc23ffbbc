#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "radiosity/camera.h"
#include "radiosity/tangent.h"
#include "radiosity/triangle_view.h"

namespace hemitex::radiosity {
namespace {

constexpr int gridSize = 5;
constexpr int viewSize = 64;
constexpr double viewFov = 60;

/// Towards the middle of the bounds, y upwards; z where the view is along y.
Camera lookingAtMiddle(const Scene& scene, const glm::dvec3& eye) {
  const glm::dvec3 direction = scene.origin - eye;
  const bool vertical = std::fabs(direction.x) + std::fabs(direction.z) <= 1e-6 * std::fabs(direction.y);
  return {eye, scene.origin, vertical ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0), viewFov};
}

/// A grid of points strictly inside the bounds without the middle one, which has no direction.
std::vector<Camera> insideCameras(const Scene& scene) {
  glm::dvec3 low = scene.origin, high = scene.origin;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec3& position : triangle.position) {
        low = glm::min(low, position);
        high = glm::max(high, position);
      }
  std::vector<Camera> cameras;
  for (int z = 1; z <= gridSize; ++z)
    for (int y = 1; y <= gridSize; ++y)
      for (int x = 1; x <= gridSize; ++x) {
        const glm::dvec3 eye = low + (high - low) * glm::dvec3(x, y, z) / (gridSize + 1.0);
        if (glm::distance(eye, scene.origin) > 1e-6 * scene.extent) cameras.push_back(lookingAtMiddle(scene, eye));
      }
  return cameras;
}

/// The corners of a cube around the bounds, from the upper ones downwards.
std::vector<Camera> outsideCameras(const Scene& scene) {
  std::vector<Camera> cameras;
  for (const double y : {1.0, -1.0})
    for (const double z : {1.0, -1.0})
      for (const double x : {1.0, -1.0})
        cameras.push_back(lookingAtMiddle(scene, scene.origin + 0.7 * scene.extent * glm::dvec3(x, y, z)));
  return cameras;
}

/// The area of the fronts that a camera sees. A pixel of area a on the plane w = 1, seen at v = P - eye, covers
/// a w^3 / |n . v| of a surface with unit normal n at P, where w is the depth of v: w^2 for the distance, and w / |n .
/// v| for the slant. The sum over the pixels of one triangle is taken for at most the triangle's area, so that a wall
/// that is seen at a grazing angle counts no more than it is.
double seenArea(const Scene& scene, TriangleView& view, const Camera& camera) {
  const double pixelSide = 2 * tangentOfDegrees(camera.fov / 2) / viewSize;
  const glm::dvec3 forward = glm::normalize(camera.lookAt - camera.eye);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> seen;  // by surface and triangle
  for (const std::optional<Visible>& sample : view.see(camera, viewSize, viewSize)) {
    if (!sample) continue;
    const Triangle& triangle = scene.surfaces[sample->surface].triangles[sample->triangle];
    glm::dvec3 v = -camera.eye;
    for (int k = 0; k < 3; ++k) v += sample->weights[k] * triangle.position[static_cast<std::size_t>(k)];
    const double w = glm::dot(forward, v);
    seen[{sample->surface, sample->triangle}] +=
        pixelSide * pixelSide * w * w * w / std::fabs(glm::dot(normal(triangle), v));
  }
  double sum = 0;
  for (const auto& [place, estimate] : seen)
    sum += std::min(estimate, area(scene.surfaces[place.first].triangles[place.second]));
  return sum;
}

struct Choice {
  Camera camera;
  double area = 0;
};

Choice bestOf(const Scene& scene, TriangleView& view, const std::vector<Camera>& cameras) {
  Choice best{cameras.front()};
  for (const Camera& camera : cameras) {
    const double area = seenArea(scene, view, camera);
    if (area > best.area) best = {camera, area};
  }
  return best;
}

}  // namespace

Camera defaultCamera(const Scene& scene) {
  TriangleView view(scene);
  const Choice inside = bestOf(scene, view, insideCameras(scene));
  return inside.area > 0 ? inside.camera : bestOf(scene, view, outsideCameras(scene)).camera;
}

}  // namespace hemitex::radiosity
