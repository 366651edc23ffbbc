/// Which triangle of the scene each sample of a picture sees, and where: an item buffer whose item IDs are the numbers
/// of the triangles. The item buffer decides what is seen, exactly; the point on the triangle is then where the
/// sample's ray meets the triangle's plane.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "raster/software/software_renderer.h"

namespace hemitex::radiosity {

/// The triangles whose backs the eye sees, ascending: pictures leave them out, so that one can look into a closed room.
std::vector<std::uint32_t> trianglesFacingAway(const Scene& scene, const glm::dvec3& eye);

/// What one sample of a picture sees.
struct Visible {
  std::uint32_t surface = 0;
  std::uint32_t triangle = 0;  ///< in Surface::triangles
  glm::dvec3 weights{0.0};     ///< barycentric, of the point on the triangle
};

/// What the samples of a picture see, width x height, row 0 at the TOP; nothing where the background is. Triangles that
/// face away are looked through.
std::vector<std::optional<Visible>> visibleSamples(const Scene& scene, const Camera& camera, int width, int height);

/// For several pictures of one scene, which must outlive it.
class TriangleView {
 public:
  explicit TriangleView(const Scene& scene);

  /// As visibleSamples.
  std::vector<std::optional<Visible>> see(const Camera& camera, int width, int height);
  /// The same, but triangles that face away are seen like others.
  std::vector<std::optional<Visible>> seeBothSides(const Camera& camera, int width, int height);

 private:
  std::vector<std::optional<Visible>> see(const raster::Face& face, const std::vector<std::uint32_t>& skipped);

  Visible locate(raster::ItemId triangle) const;

  const Scene& scene_;
  std::vector<raster::ItemId> firstTriangle_;  ///< one a surface: the number of its first triangle in the scene
  raster::SoftwareRenderer renderer_;
};

}  // namespace hemitex::radiosity
