/// Adaptive subdivision (Cohen, Greenberg, Immel and Brock 1986): splits elements where radiosity changes fast.
///
/// The estimate uses a coarse solution. Across an element of side s the radiosity changes by about |b - b'| s / d. Here
/// b' is the radiosity of a neighbour whose centre is at distance d. An element has constant radiosity, so its error is
/// a share of that change, on its whole area. An element is split while area times change, relative to all light of the
/// scene (the sum of area times radiosity), is above a tolerance. So small elements at shadow borders and large
/// elements with slow changes contribute equally to the error. The scene is solved again with the smaller elements,
/// level by level.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Computes the radiosity of each element of a discretization.
using SolveElements = std::function<std::vector<glm::dvec3>(const Discretization&)>;

/// Elements along the side of a surface in the first round; fewer if the surface has fewer texels.
inline constexpr int coarsestElements = 4;

/// The quadtrees of the discretization after splitting and balancing. A leaf is split if its area times change is above
/// `tolerance` of all light, summed over bands. The discretization must have quadtrees.
std::vector<Quadtree> refined(const Discretization& discretization, std::span<const glm::dvec3> radiosity,
                              double tolerance);

/// Solves and refines from quadtrees of `coarsestElements` along a side until no element is split, at the latest at the
/// texels of the settings. Grids have 2^n x 2^n texels: the sides of those of the settings grow to the smallest power
/// of two. Throws InputError as discretize.
Discretization adaptiveDiscretization(const Scene& scene, const DiscretizationSettings& settings, double tolerance,
                                      const SolveElements& solveElements);

}  // namespace hemitex::radiosity
