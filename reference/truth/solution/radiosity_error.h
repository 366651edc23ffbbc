/// The error of a solution.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::reference {

/// Bands are summed. All errors are relative to the true radiosity, and 0 if reference and solution are both dark.
struct RadiosityError {
  double fluxWeighted = 0;  ///< sum of area |b - truth| over the sum of area truth
  double rms = 0;           ///< root of the area-weighted mean of (b - truth)^2, over that of truth
  double maximum = 0;       ///< the largest |b - truth| of an element, over the area-weighted mean of truth
};

/// For each element of `fine`, the element of another discretization of the same scene at the centre of its own texel.
/// If the fine grids subdivide the coarse ones and no texels have merged, the coarse element contains the fine one.
std::vector<std::uint32_t> elementsUnder(const radiosity::Discretization& coarse,
                                         const radiosity::Discretization& fine);

/// A solution, sampled at the elements of another discretization (see elementsUnder). Compared with a reference on
/// finer grids, its error includes that of constant elements.
std::vector<glm::dvec3> onOtherGrids(const radiosity::Discretization& coarse, std::span<const glm::dvec3> radiosity,
                                     const radiosity::Discretization& fine);

/// The error of all elements. Both arguments have one radiosity per element.
RadiosityError errorOf(const radiosity::Discretization& discretization, std::span<const glm::dvec3> found,
                       std::span<const glm::dvec3> truth);

}  // namespace hemitex::reference
