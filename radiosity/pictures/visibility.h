/// The visible triangle and point of each sample of a picture, from an item buffer whose item IDs are the numbers of
/// triangles. The item buffer decides visibility exactly. The point is the intersection of the sample's ray and the
/// triangle's plane.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "raster/software/software_renderer.h"

namespace hemitex::radiosity {

/// The triangles whose backs face the eye, ascending. Pictures leave them out, so that closed rooms can be seen from
/// outside.
std::vector<std::uint32_t> trianglesFacingAway(const Scene& scene, const glm::dvec3& eye);

/// The visible point of one sample.
struct Visible {
  std::uint32_t surface = 0;
  std::uint32_t triangle = 0;  ///< in Surface::triangles
  glm::dvec3 weights{0.0};     ///< barycentric weights of the point, of the triangle's corners 1 and 2
};

/// The visible points of all samples, width x height, row 0 at the TOP; nothing for the background. Triangles that face
/// away are invisible.
std::vector<std::optional<Visible>> visibleSamples(const Scene& scene, const Camera& camera, int width, int height);

/// For several pictures of one scene, which must outlive it.
class TriangleView {
 public:
  explicit TriangleView(const Scene& scene);

  /// As visibleSamples.
  std::vector<std::optional<Visible>> see(const Camera& camera, int width, int height);
  /// As visibleSamples, but triangles that face away are visible.
  std::vector<std::optional<Visible>> seeBothSides(const Camera& camera, int width, int height);

 private:
  std::vector<std::optional<Visible>> see(const raster::Face& face, const std::vector<std::uint32_t>& skipped);

  Visible locate(raster::ItemId triangle) const;

  const Scene& scene_;
  std::vector<raster::ItemId> firstTriangle_;  ///< one per surface: the number of its first triangle in the scene
  raster::SoftwareRenderer renderer_;
};

}  // namespace hemitex::radiosity
