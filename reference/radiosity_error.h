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

/// Of all elements. Both hold a radiosity an element.
RadiosityError errorOf(const radiosity::Discretization& discretization, std::span<const glm::dvec3> found,
                       std::span<const glm::dvec3> truth);

/// Of the elements of each surface by themselves, one a surface.
std::vector<RadiosityError> errorsBySurface(const radiosity::Discretization& discretization,
                                            std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth);

/// |b - truth| over truth of each element; infinite where only the truth is dark.
std::vector<double> errorsByElement(std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth);

}  // namespace hemitex::reference
