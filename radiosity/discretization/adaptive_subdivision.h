/// Adaptive subdivision (Cohen, Greenberg, Immel and Brock 1986): elements are split where radiosity changes fast.
///
/// A coarse solution tells where. Across an element of side s the radiosity changes by about |b - b'| s / d, where b'
/// is that of a neighbour whose centre lies d further on. Constant over the element, radiosity is wrong by a share of
/// that change on all of its area; so an element is split while its area times its change, against all light of the
/// scene (the sum of area times radiosity), is above a tolerance. Small elements on the border of a shadow and large
/// ones under a slow change then carry alike to the error. The quarters are solved for again, level by level.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The radiosity of every element of a discretization.
using SolveElements = std::function<std::vector<glm::dvec3>(const Discretization&)>;

/// The first round has this many elements along a surface's side, or one a texel where it has fewer.
inline constexpr int coarsestElements = 4;

/// The quadtrees of a discretization that has them, leaves split where area times change is above `tolerance` of all
/// light, bands summed, and then balanced.
std::vector<Quadtree> refined(const Discretization& discretization, std::span<const glm::dvec3> radiosity,
                              double tolerance);

/// Starts with quadtrees of `coarsestElements` along a side and solves and refines until nothing is split any more, at
/// the latest after the texels of the settings. Each surface has 2^n x 2^n of them; throws InputError where one has
/// not, and as discretize does.
Discretization adaptiveDiscretization(const Scene& scene, const DiscretizationSettings& settings, double tolerance,
                                      const SolveElements& solveElements);

}  // namespace hemitex::radiosity
