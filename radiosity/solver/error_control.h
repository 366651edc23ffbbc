/// Chooses solver settings for a bound on the error.
///
/// The error of a solution is the flux by which its elements differ from the true radiosity, as a share of all flux. It
/// has two causes with one setting each: shooting from one point for too large a patch (the limit of splits), and
/// directions between pixels (the resolution of hemicubes). A ladder of efforts refines both together. Each step
/// multiplies the work by about 1.6 and the error by about two thirds.
///
/// The error is estimated from solutions at consecutive efforts. Hemicubes of different resolutions over different
/// parts of patches have mostly independent errors. Let two solutions have errors e and e' < e, and let D be their
/// difference. Then D^2 = e^2 + e'^2, and e' is below D / sqrt(2). A share of the bound is reserved for the errors that
/// both have in common. The result is the first solution whose expected error is within the bound. It is an estimate,
/// not a proof for every scene.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::radiosity {

/// The effort of a solution.
struct Effort {
  double split = 0.003;  ///< see PatchSubdivision
  int resolution = 256;  ///< of hemicubes
};

struct ErrorBoundChoice {
  Effort effort;             ///< of the last solution
  double expectedError = 0;  ///< its expected error
};

/// Solves at an effort; returns the radiosity of each element in W/m^2.
using SolveWith = std::function<std::vector<glm::dvec3>(const Effort&)>;

/// The share of all emitted flux that may stay unshot for a bound on the error: a tenth of the bound.
double residualFor(double bound);

/// Solves at growing efforts until the expected error, a share of all flux, is within `bound`, above 0. Throws
/// InputError if no effort of the ladder is enough; the advice says which bound can be reached.
ErrorBoundChoice chooseEffort(const Discretization& discretization, const SolveWith& solveWith, double bound);

}  // namespace hemitex::radiosity
