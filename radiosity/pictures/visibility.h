/// The visible triangle and point of each sample of a picture, from an item buffer whose item IDs are the numbers of
/// triangles. The item buffer decides visibility exactly. The point is the intersection of the sample's ray and the
/// triangle's plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "raster/software/software_renderer.h"

namespace hemitex::radiosity {

/// The visible point of one sample.
struct Visible {
  std::uint32_t surface = 0;
  std::uint32_t triangle = 0;  ///< in Surface::triangles
  glm::dvec3 weights{0.0};     ///< barycentric, of the three corners; their sum is 1
  std::uint32_t instance = 0;  ///< in Scene::instances
};

/// The position in space of a visible point.
glm::dvec3 positionOf(const Scene& scene, const Visible& visible);

/// The visible points of all samples, width x height, row 0 at the TOP; nothing for the background. Triangles that face
/// away are invisible, so that closed rooms can be seen from outside. Throws InputError as cameraFace.
std::vector<std::optional<Visible>> visibleSamples(const Scene& scene, const Camera& camera, int width, int height);

/// Whether a picture shows at least an eighth of the area of each surface, or at least half of its samples show the
/// surface; one value per surface. So a camera in a room sees its walls, but through a window it does not see the
/// ground around the house. Throws InputError as cameraFace.
std::vector<bool> seenSurfaces(const Scene& scene, const Camera& camera, int width, int height);

/// For several pictures of one scene, which must outlive it.
class TriangleView {
 public:
  explicit TriangleView(const Scene& scene);

  /// As visibleSamples, but only the triangles in `skipped` (numbers in space, ascending) are invisible.
  std::vector<std::optional<Visible>> see(const Camera& camera, int width, int height,
                                          std::span<const std::uint32_t> skipped);
  /// Calls visitSample(sample, its visible point) for the samples of `see` that do not show the background, in any
  /// order and from several threads at a time. `shift` moves the samples to the right and up, in distances of samples.
  /// With `wanted`, one per sample, the others are left out.
  void visit(const Camera& camera, int width, int height, std::span<const std::uint32_t> skipped,
             const glm::vec2& shift, std::span<const std::uint8_t> wanted,
             const std::function<void(std::size_t, const Visible&)>& visitSample);

 private:
  const Scene& scene_;
  std::vector<TrianglePlace> places_;  ///< of each triangle
  raster::SoftwareRenderer renderer_;
};

}  // namespace hemitex::radiosity
