/// Far, narrow views of a whole scene, which show it as parallel light from one direction meets it. A rasterizer draws
/// perspective views only, so that the eye is far away instead of infinitely far. Each pixel stands for a beam of the
/// same cross-section.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/geometry/nearest_boxes.h"
#include "radiosity/projection/projection.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

/// The distance of the eye in radii of the scene. Directions differ by up to 1/1024 within a view, and cross-sections
/// of beams by 0.2 %. A farther eye would lose digits: with this one binary32 rounding moves points by up to 2^-15
/// radii.
inline constexpr double farDistance = 1024;

/// A sphere around all triangles, and the box in it that has the same centre; in units of the file.
struct BoundingSphere {
  glm::dvec3 centre{0.0};
  double radius = 0;
  SpaceBox box;
};
BoundingSphere boundingSphere(const Scene& scene);

/// Views of resolution x resolution pixels.
struct ParallelViews {
  BoundingSphere bounds;
  int resolution = 0;  ///< even, 4 to 4096

  /// The side of a pixel at the centre of the scene, in units of the file. A pixel at each border shows no scene.
  double pixelSide() const { return 2 * bounds.radius / (resolution - 2); }
  /// A view against the light: `towards` is the unit vector to its source. Views of different numbers are rotated about
  /// this direction and moved by parts of a pixel, so that the samples of many views are spread evenly. The scissor
  /// rectangle holds all pixels that show the scene, of which `origin` is the origin.
  raster::Face face(const glm::dvec3& origin, const glm::dvec3& towards, std::uint32_t number) const;
  /// One face whose pixels have the share 1 each, so that sums count pixels.
  Projection pixelCounts() const;
};

/// Evenly spread directions over the whole sphere: the spherical Fibonacci lattice, which integrates light over
/// directions with a smaller error than Sobol points do (Marques, Bouville, Ribardiere, Santos and Bouatouch 2013).
/// Unit vectors, each for the same solid angle; `count` is at least 1. The bits are equal on all machines.
std::vector<glm::dvec3> sphereDirections(int count);

}  // namespace hemitex::radiosity
