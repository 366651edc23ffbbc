/// The truth for a whole scene: every form factor from element to element measured by rays, the equations solved
/// directly (see direct_solution.h). What is left of error is chance, and how much is told.
///
/// Rays go where the light is: a quarter of them is spread evenly over the elements, the others by the flux that leaves
/// each, as a few bounces along a coarse matrix have it. So most rays carry alike, and errors are half of what as many
/// rays from every element would leave. They fall with the root of the samples: of cornell-box with 16 texels (4088
/// elements), 2^12 samples leave 0.5 % and take 7 s on two cores, the equations another 20 s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/rays/monte_carlo_form_factors.h"
#include "reference/solution/direct_solution.h"
#include "reference/solution/form_factor_matrix.h"
#include "reference/solution/radiosity_error.h"

namespace hemitex::reference {

/// Each of the two matrices has 200 MB then, and solving takes twice that again.
inline constexpr std::size_t maxTrueElements = 5000;

/// The form factors from every element to every element, averaged over the one that shoots: over the hemisphere, with
/// `samples` rays of each element (see Sampling::samples), and a seed of its own. The same bits for any number of
/// threads.
FormFactorMatrix measuredMatrix(const RayFormFactors& rays, const radiosity::Discretization& discretization,
                                std::span<const int> samples, std::uint32_t seed);

struct TrueRadiosity {
  FormFactorMatrix matrix;            ///< from element to element: the mean of two measurements that are independent
  FormFactorMatrix spread;            ///< half of their difference, which is distributed as the error of their mean
  std::vector<glm::dvec3> radiosity;  ///< one an element, W/m^2 per band
  RadiosityError error;               ///< expected of `radiosity`: what `spread` does to light that is reflected once
};

/// `sampling.samples`: rays an element on average. Throws InputError where there are more than `maxTrueElements`
/// elements.
TrueRadiosity trueRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                            const Sampling& sampling);

}  // namespace hemitex::reference
