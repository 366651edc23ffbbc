/// The ground truth of a whole scene: all form factors between elements, measured by rays, and the direct solution of
/// the equations (see direct_solution.h). The remaining error is random, and its expected size is returned.
///
/// A quarter of the rays is distributed uniformly over the elements. The others are distributed by the flux that leaves
/// each element, estimated with a few bounces and a coarse matrix. So most rays carry similar flux, and errors are half
/// of those with the same number of rays from each element. Errors fall with the root of the number of samples. For
/// cornell-box with 16 texels (4088 elements), 2^12 samples leave 0.5 % and take 7 s on two cores. The equations take
/// another 20 s.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "reference/truth/solution/direct_solution.h"
#include "reference/truth/solution/form_factor_matrix.h"
#include "reference/truth/solution/radiosity_error.h"

namespace hemitex::reference {

/// Each of the two matrices then takes 200 MB, and solving takes twice that in addition.
inline constexpr std::size_t maxTrueElements = 5000;

struct TrueRadiosity {
  FormFactorMatrix matrix;  ///< from element to element: the mean of two independent measurements
  FormFactorMatrix spread;  ///< half of their difference, which has the distribution of the error of their mean
  std::vector<glm::dvec3> radiosity;  ///< one per element, W/m^2 per band
  RadiosityError error;  ///< expected error of `radiosity`: the effect of `spread` on light that is reflected once
};

/// `sampling.samples` is the mean number of rays per element. Throws InputError if there are more than
/// `maxTrueElements` elements.
TrueRadiosity trueRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                            const Sampling& sampling);

}  // namespace hemitex::reference
