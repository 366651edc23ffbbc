/// The visible triangle and point of each sample of a picture, from an item buffer whose item IDs are the numbers of
/// triangles. The item buffer decides visibility exactly. The point is the intersection of the sample's ray and the
/// triangle's plane.
#pragma once

#include <cstdint>
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

/// The triangles that the samples of a picture show. Points are computed per row, because those of a whole picture take
/// fifty bytes per sample.
class TriangleSamples {
 public:
  /// The visible points of a row, row 0 at the TOP; nothing for the background. With `wanted`, one per sample, the
  /// others are left out.
  std::vector<std::optional<Visible>> row(int row, std::span<const std::uint8_t> wanted = {}) const;
  int rows() const { return numbers_.height; }

 private:
  friend class TriangleView;
  TriangleSamples(const Scene& scene, std::span<const TrianglePlace> places, const raster::Face& face,
                  const raster::ItemBuffer& numbers)
      : scene_(scene), places_(places), face_(face), numbers_(numbers) {}

  const Scene& scene_;
  std::span<const TrianglePlace> places_;
  raster::Face face_;
  const raster::ItemBuffer& numbers_;  ///< of triangles, row 0 at the bottom
};

/// For several pictures of one scene, which must outlive it.
class TriangleView {
 public:
  explicit TriangleView(const Scene& scene);

  /// Only the triangles in `skipped` (numbers in space, ascending) are invisible. `shift` moves the samples to the
  /// right and up, in distances of samples. The result refers to the view, and is valid until the next call. Throws
  /// InputError as cameraFace.
  TriangleSamples see(const Camera& camera, int width, int height, std::span<const std::uint32_t> skipped,
                      const glm::vec2& shift = {});

 private:
  const Scene& scene_;
  std::vector<TrianglePlace> places_;  ///< of each triangle
  raster::SoftwareRenderer renderer_;
  std::vector<raster::ItemBuffer> buffers_;  ///< one, whose memory is reused
};

/// The visible points of all samples, row by row from the top.
std::vector<std::optional<Visible>> allPoints(const TriangleSamples& samples);

}  // namespace hemitex::radiosity
