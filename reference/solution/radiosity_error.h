/// How far a solution is from the truth.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"

namespace hemitex::reference {

/// Bands are summed. All are relative to the true radiosity, 0 where truth and solution are both dark.
struct RadiosityError {
  double fluxWeighted = 0;  ///< sum of area |b - truth| over the sum of area truth
  double rms = 0;           ///< root of the area's mean of (b - truth)^2, over the area's mean of truth
  double maximum = 0;       ///< the largest |b - truth| of an element, over the area's mean of truth
};

/// For every element of `fine`, the element of another discretization of the same scene that the centre of its own
/// texel lies in. Where the fine grids divide the coarse ones and no texels have merged, fine elements lie whole in it.
std::vector<std::uint32_t> elementsUnder(const radiosity::Discretization& coarse,
                                         const radiosity::Discretization& fine);

/// A solution as the elements of another discretization see it (see elementsUnder). Compared with a truth on finer
/// grids it also counts what pieces of constant radiosity cannot show.
std::vector<glm::dvec3> onOtherGrids(const radiosity::Discretization& coarse, std::span<const glm::dvec3> radiosity,
                                     const radiosity::Discretization& fine);

/// Of all elements. Both hold a radiosity an element.
RadiosityError errorOf(const radiosity::Discretization& discretization, std::span<const glm::dvec3> found,
                       std::span<const glm::dvec3> truth);

/// Of the elements of each surface by themselves, one a surface.
std::vector<RadiosityError> errorsBySurface(const radiosity::Discretization& discretization,
                                            std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth);

/// |b - truth| over truth of each element; infinite where only the truth is dark.
std::vector<double> errorsByElement(std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth);

}  // namespace hemitex::reference
