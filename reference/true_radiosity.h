/// The truth for a whole scene: every form factor from element to element measured by rays, the equations solved
/// directly (see algebraic_solution.h). What is left of error is chance, and it is told.
///
/// Everything is done twice, with independent samples. The mean of the two solutions is the truth, and half of their
/// difference is distributed as the error of their mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/scene.h"
#include "reference/algebraic_solution.h"
#include "reference/radiosity_error.h"
#include "reference/ray_form_factors.h"

namespace hemitex::reference {

/// The matrix has 200 MB then, and its decomposition takes twice that again.
inline constexpr std::size_t mostTrueElements = 5000;

/// The form factors from every element to every element, averaged over the one that shoots: rays over the hemisphere,
/// sampling.samples of each element, each with a seed of its own. The same bits for any number of threads.
FormFactorMatrix measuredMatrix(const RayFormFactors& rays, const radiosity::Discretization& discretization,
                                const Sampling& sampling);

struct TrueRadiosity {
  FormFactorMatrix matrix;            ///< from element to element
  std::vector<glm::dvec3> radiosity;  ///< one an element, W/m^2 per band
  RadiosityError error;               ///< expected, by chance, of `radiosity`
};

/// Half of sampling.samples for each of the two solutions. Throws InputError where there are more than
/// `mostTrueElements` elements.
TrueRadiosity trueRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                            const Sampling& sampling);

}  // namespace hemitex::reference
