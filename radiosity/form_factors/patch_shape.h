/// A patch as its receivers see it: polygons, whose form factors are closed forms, and points, which rays aim at.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A point of an element or a patch, and the area that it stands for.
struct AreaSample {
  SurfacePoint point;
  glm::dvec3 eye{0.0};  ///< over the point (see eyeOver)
  double area = 0;
};

/// A patch at one instance of the scene.
struct PatchShape {
  struct Polygon {
    std::vector<glm::dvec3> corners;  ///< counter-clockwise as seen from the front; convex
    Plane plane;
  };

  std::vector<Polygon> polygons;
  std::vector<AreaSample> samples;  ///< up to 16; any four in a row are from different quarters
  Bounds bounds = {};
  double area = 0;
};

/// The shapes of a patch, one per instance.
std::vector<PatchShape> shapesOf(const Scene& scene, const Discretization& discretization, const Patch& patch);

/// An element that sees patches.
struct SeeingElement {
  std::uint32_t number = 0;
  AreaSample centre;
  std::vector<AreaSample> quarters;  ///< of its texel or leaf, as far as they have exposed area; else the centre
  Bounds bounds = {};                ///< of its texel or leaf
};

SeeingElement seeingElement(const Scene& scene, const Discretization& discretization, std::uint32_t number);

/// The form factor from an element to a patch, in the mean over points of the element: more points the nearer it is.
/// `isClear` if nothing is between them; else rays find the visible share.
double formFactorTo(const PatchShape& shape, const Scene& scene, const Discretization& discretization,
                    const SeeingElement& element, const RayTree& tree, bool isClear);

}  // namespace hemitex::radiosity
