/// Derivatives of weighted sums of radiosity by all emissions and reflectances at once.
///
/// Let the flux that leaves element j be
///
///     flux_j = E_j A_j + rho_j (S_j + sum_i F_ij flux_i)
///
/// with emitted radiosity E, area A, reflectance rho, the flux S from outside, and the share F_ij of the flux of
/// element i that reaches j: the row of its patch. The target is J = sum_j w_j B_j with the radiosity B_j = flux_j /
/// A_j. One solution of the transposed equations, the importance
///
///     L_i = w_i / A_i + sum_j F_ij rho_j L_j,
///
/// gives all derivatives (Smits, Arvo and Salesin 1992, An importance-driven radiosity algorithm):
///
///     dJ/dE_i = A_i L_i,    dJ/drho_j = L_j (S_j + sum_i F_ij flux_i),    J = sum_i L_i (E_i A_i + rho_i S_i).
///
/// Elements of one patch have one row, so that the unknown of the transposed equations is one sum per patch. Both
/// equations are solved by iteration until a step changes the values by less than 1e-14, relative; the error is then
/// below that over 1 minus the largest reflectance.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/solver/progressive_solver.h"

namespace hemitex::radiosity {

/// Bands do not mix: band b of a derivative is that of band b of the target by band b of the emission or reflectance.
struct Sensitivity {
  glm::dvec3 target{0.0};                 ///< J per band
  std::vector<glm::dvec3> byEmission;     ///< one per element: dJ/dE, E in W/m^2
  std::vector<glm::dvec3> byReflectance;  ///< one per element: dJ/drho, in the unit of J
  std::vector<glm::dvec3> radiosity;      ///< one per element, W/m^2 per band: the solution of the equations
};

/// Called before each row, and each step of the iterations behind the last one, with the numbers of rows computed so
/// far and in all. An exception that it throws ends the computation.
using RowProgress = std::function<void(std::size_t done, std::size_t all)>;

/// The derivatives of some targets, each with one weight per element and band, of any sign, in a scene without
/// wavelengths. Rows and radiosity are computed once for all targets. Of the input it uses the scene, the
/// discretization, the patches, their rows and the light from outside; patches are not split. All rows are in memory at
/// a time, 12 bytes per entry. The result does not depend on threads.
std::vector<Sensitivity> sensitivities(const SolveInput& input, std::span<const std::vector<glm::dvec3>> targets,
                                       const RowProgress& progress = {});

}  // namespace hemitex::radiosity
