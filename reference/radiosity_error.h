/// How far a solution is from the truth.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization.h"

namespace hemitex::reference {

/// Bands are summed. All are relative to the true radiosity, 0 where truth and solution are both dark.
struct RadiosityError {
  double fluxWeighted = 0;  ///< sum of area |b - truth| over the sum of area truth
  double rms = 0;           ///< root of the area's mean of (b - truth)^2, over the area's mean of truth
  double maximum = 0;       ///< the largest |b - truth| of an element, over the area's mean of truth
};

/// A solution on one discretization as the elements of another one of the same scene see it: each has the radiosity of
/// the element that the centre of its own texel lies in. Where the fine grids divide the coarse ones and no texels have
/// merged that is the solution itself, so comparing it with a truth on fine grids also counts what pieces of constant
/// radiosity cannot show.
std::vector<glm::dvec3> onOtherGrids(const radiosity::Discretization& discretization,
                                     std::span<const glm::dvec3> radiosity, const radiosity::Discretization& other);

/// Of all elements. Both hold a radiosity an element.
RadiosityError errorOf(const radiosity::Discretization& discretization, std::span<const glm::dvec3> found,
                       std::span<const glm::dvec3> truth);

/// Of the elements of each surface by themselves, one a surface.
std::vector<RadiosityError> errorsBySurface(const radiosity::Discretization& discretization,
                                            std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth);

/// |b - truth| over truth of each element; infinite where only the truth is dark.
std::vector<double> errorsByElement(std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth);

}  // namespace hemitex::reference
