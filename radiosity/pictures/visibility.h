/// Which triangle of the scene each sample of a picture sees, and where: an item buffer whose words are the numbers
/// of the triangles. The item buffer decides what is seen, exactly; the point on the triangle is then where the
/// sample's ray meets the triangle's plane.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "raster/software/software_renderer.h"

namespace hemitex::radiosity {

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

  Visible locate(raster::Word triangle) const;

  const Scene& scene_;
  std::vector<raster::Word> firstTriangle_;  ///< one a surface: the number of its first triangle in the scene
  raster::SoftwareRenderer renderer_;
};

}  // namespace hemitex::radiosity
