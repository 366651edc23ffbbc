/// Parts of surfaces as triangles, and form factors between two that are near each other: closed forms in the mean over
/// points, times the visible share, by rays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The exposed triangles of a part of a surface, in units of the file.
struct SurfacePart {
  struct Face {
    std::array<glm::dvec3, 3> corners;  ///< counter-clockwise in front
    glm::dvec3 normal;                  ///< unit
    double area = 0;                    ///< above 0
  };

  std::vector<Face> faces;  ///< none if the part has almost no area
  Bounds bounds = {};
  double area = 0;

  /// The diagonal of its bounds.
  double size() const { return glm::length(bounds.high - bounds.low); }
};

/// The rectangle of a patch in the first instance of its scene. Visits all triangles of the surface.
SurfacePart partOf(const Scene& scene, const Discretization& discretization, const Patch& patch);
/// The texel or leaf of an element.
SurfacePart partOf(const Scene& scene, const Discretization& discretization, std::uint32_t element);
/// A part in another instance.
SurfacePart placed(const SurfacePart& part, const Instance& instance);

/// Point k of a sequence that is spread evenly over the unit square, by multiples of 1/p and 1/p^2 with p^3 = p + 1.
glm::dvec2 spreadPoint(std::size_t k);

/// A point on one of several triangles.
struct PlacedPoint {
  glm::dvec3 position;
  std::size_t face = 0;
};
/// The point for a point of the unit square, evenly by area; at least one face.
PlacedPoint pointAt(std::span<const SurfacePart::Face> faces, const glm::dvec2& at);

/// The distance between two boxes; 0 if they meet.
double distanceBetween(const Bounds& a, const Bounds& b);

struct NearAccuracy {
  double least = 0;       ///< a smaller result does not matter, so that it may be 0
  double height = 0;      ///< the distance from both parts at which rays end, in units of the file
  std::size_t rays = 64;  ///< a multiple of 4
};

/// The form factor between two parts times the area of either: the mean over points of the smaller part. The points are
/// the closer together the more the form factor from points changes; accurate to about 0.5 %. Times the share of rays
/// between these points and the other part that meet nothing.
double exchangeArea(const SurfacePart& a, const SurfacePart& b, const RayTree& tree, const NearAccuracy& accuracy);

}  // namespace hemitex::radiosity
