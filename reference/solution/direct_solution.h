/// The algebraic solution of radiosity: every form factor at hand, the linear equations solved directly. It is the
/// truth that progressive refinement comes near shot by shot.
///
/// With F_ij the share of the flux leaving element i that reaches j, what leaves element j is what it emits and what it
/// reflects of all others (Goral, Torrance, Greenberg and Battaile 1984, equation 4, times the area of j):
///
///     flux_j = emitted_j + reflectance_j sum_i F_ij flux_i
///
/// Written for flux it needs no reciprocity of the matrix: it is what shooting along its rows for ever would give.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "reference/solution/form_factor_matrix.h"

namespace hemitex::reference {

struct DirectSolution {
  std::vector<glm::dvec3> flux;  ///< that leaves each element, per band
  double residual = 0;           ///< what the equations miss over all flux, sums of sizes; the worst band
};

/// Flux from emitted flux and reflectance of each element, by LU decomposition and iterative refinement; of a row sum
/// up to 1 and reflectance up to 0.9999 the residual is below 1e-12. Memory is twice that of the matrix, time grows
/// with the cube of its size (5000 elements: 400 MB).
DirectSolution solveDirectly(const FormFactorMatrix& matrix, std::span<const glm::dvec3> emitted,
                             std::span<const glm::dvec3> reflectance);

/// Radiosity of every element of a discretized scene, per band.
std::vector<glm::dvec3> algebraicRadiosity(const radiosity::Scene& scene,
                                           const radiosity::Discretization& discretization,
                                           const FormFactorMatrix& matrix);

}  // namespace hemitex::reference
