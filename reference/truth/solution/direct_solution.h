/// The direct solution of radiosity: the linear equations of a complete form-factor matrix. Progressive refinement
/// converges to it.
///
/// Let F_ij be the share of the flux leaving element i that reaches j. The flux leaving element j is its emitted flux
/// plus its reflected flux (Goral, Torrance, Greenberg and Battaile 1984, equation 4, times the area of j):
///
///     flux_j = emitted_j + reflectance_j sum_i F_ij flux_i
///
/// In terms of flux, the equations need no reciprocity of the matrix. They give the limit of shooting along its rows.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "reference/truth/solution/form_factor_matrix.h"

namespace hemitex::reference {

/// Outgoing flux of each element, per band, from the emitted flux and the reflectance of each, by LU decomposition and
/// iterative refinement. For row sums up to 1 and reflectances up to 0.9999 the residual of the equations is below
/// 1e-12 of all flux. Takes twice the memory of the matrix, and time proportional to the cube of its size (5000
/// elements: 400 MB).
std::vector<glm::dvec3> solveDirectly(const FormFactorMatrix& matrix, std::span<const glm::dvec3> emitted,
                                      std::span<const glm::dvec3> reflectance);

/// Radiosity of each element of a discretized scene, per band.
std::vector<glm::dvec3> algebraicRadiosity(const radiosity::Scene& scene,
                                           const radiosity::Discretization& discretization,
                                           const FormFactorMatrix& matrix);

}  // namespace hemitex::reference
