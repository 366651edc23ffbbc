/// Scenes that continue behind mirror planes or in periodic boxes: their images are instances of the same surfaces
/// (Scene::instances), which are drawn and seen by the same rules. The form factor to a surface is the sum over its
/// images, and all images of an element have the same light.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

struct Symmetry {
  /// The coordinates of the mirror planes across each axis, at most two. Between two planes the images have no end;
  /// they are repeated with twice the distance as their period.
  std::array<std::vector<double>, 3> mirrors = {};
  glm::dvec3 period{0.0};  ///< along each axis, in units of the file; 0: none. Not together with mirrors of this axis
  /// Images on each side of a box that is repeated (4 if not given). Light that goes farther meets the surroundings.
  std::optional<int> repeats = {};

  bool isNone() const;
};

/// Gives a scene its instances, and measures the bounds again. Throws InputError if a surface crosses a mirror plane,
/// two planes of an axis are one, an axis has both mirrors and a period, repeats are given although nothing is
/// repeated, or an image is farther away than 4096 times the scene's size; or if the instances have more than 2^28
/// triangles. Throws SizeError if there is no memory to draw them.
void setSymmetry(Scene& scene, const Symmetry& symmetry);

}  // namespace hemitex::radiosity
