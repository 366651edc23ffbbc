/// Settings for a bound on the error: as much work as the scene asks for.
///
/// The error of a solution is the flux by which its elements differ from the true radiosity, as a share of all flux.
/// Two things cause it, and each has its setting: points that shoot for too large patches (the limit of splits) and
/// directions between pixels (the resolution of hemicubes). A ladder of efforts refines both together. From step to
/// step work grows by about 1.6, and the error falls to about two thirds.
///
/// How large the error is, the scene itself says: it is solved at one effort after the other. Hemicubes of different
/// resolutions over different parts of patches err independently for the most part, so that two solutions of errors e
/// and e' < e differ by D with D^2 = e^2 + e'^2, and e' is below D / sqrt(2). A share of the bound is left for what
/// both have in common. The first solution of which so much is expected is the answer. It is an estimate, and no proof
/// for every scene.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::radiosity {

/// How hard a solution tries.
struct Effort {
  double split = 0.003;  ///< see PatchSubdivision
  int resolution = 256;  ///< of hemicubes
};

struct ErrorBoundChoice {
  Effort effort;             ///< of the last solution that was asked for
  double expectedError = 0;  ///< its error
};

/// Solves at an effort; the radiosity of every element.
using SolveWith = std::function<std::vector<glm::dvec3>(const Effort&)>;

/// The share of all emitted flux that may stay unshot for a bound on the error: a tenth of the bound.
double residualFor(double bound);

/// Solves at growing efforts until the expected error is within `bound`, above 0. Throws InputError where no effort of
/// the ladder is enough; the advice says which bound is in reach.
ErrorBoundChoice chooseEffort(const Discretization& discretization, const SolveWith& solveWith, double bound);

}  // namespace hemitex::radiosity
