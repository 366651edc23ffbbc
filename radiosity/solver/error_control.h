/// Chooses solver settings for a bound on the error.
///
/// The error of a solution is the flux by which its elements differ from the true radiosity, as a share of their flux.
/// The flux includes what the elements emit. There are two errors: that of all elements, and that of the elements of
/// seen surfaces, of which a picture shows enough (see seenSurfaces). A bound holds for both. So a large bright ground
/// around a house does not hide the errors in a room.
///
/// Errors have two causes with one setting each: shooting from one point for too large a patch (the limit of splits),
/// and directions between pixels (the resolution of hemicubes). A ladder of efforts refines both together. Each step
/// multiplies the work by about 1.6 and the error by about two thirds.
///
/// The error is estimated from solutions at consecutive efforts. Hemicubes of different resolutions over different
/// parts of patches have mostly independent errors. Let two solutions have errors e and e' < e, and let D be their
/// difference. Then D^2 = e^2 + e'^2, and e' is below D / sqrt(2). A share of the bound is reserved for the errors that
/// both have in common. The result is the first solution whose expected errors are within the bound. They are
/// estimates, not proofs for every scene.
#pragma once

#include <algorithm>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::radiosity {

/// The effort of a solution.
struct Effort {
  double split = 0.003;  ///< see PatchSubdivision
  int resolution = 256;  ///< of hemicubes
};

/// The errors of a solution.
struct LightErrors {
  double all = 0;   ///< of all elements
  double seen = 0;  ///< of those of seen surfaces

  double larger() const { return std::max(all, seen); }
};

/// The errors of `found` against `truth`, one radiosity per element. `seen` has one value per surface, or is empty if
/// no surface is seen.
LightErrors lightErrors(const Discretization& discretization, const std::vector<bool>& seen,
                        std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth);

struct ErrorBoundChoice {
  Effort effort;  ///< of the last solution
  /// Of the last solution; nothing if it is the first one, so that none is there to compare it with.
  std::optional<LightErrors> expectedErrors;
};

/// Where a choice of effort begins, and when it ends before the bound is kept.
struct EffortLimits {
  Effort coarsest{1, 0};              ///< no solution has a larger limit of splits, or a lower resolution
  std::function<bool()> isLast = {};  ///< whether the last solution met a limit, so that none has more effort
};

/// Solves at an effort; returns the radiosity of each element in W/m^2.
using SolveWith = std::function<std::vector<glm::dvec3>(const Effort&)>;

/// The share of all emitted flux that may stay unshot for a bound on the error: a tenth of the bound.
double residualFor(double bound);

/// Throws InputError if fewer than two efforts of the ladder are as fine as `coarsest`: two solutions are compared.
void requireEfforts(const Effort& coarsest);

/// Solves at growing efforts until both expected errors are within `bound`, above 0, or a limit is met. See lightErrors
/// for `seen`. Throws InputError as requireEfforts, and if no effort of the ladder is enough; the advice says which
/// bound can be reached.
ErrorBoundChoice chooseEffort(const Discretization& discretization, const std::vector<bool>& seen,
                              const SolveWith& solveWith, double bound, const EffortLimits& limits = {});

}  // namespace hemitex::radiosity
