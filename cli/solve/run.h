/// The computation of `hemitex solve`: solves the scene, and chooses elements or settings by solutions.
#pragma once

#include <optional>

#include "cli/report/solved_page.h"
#include "cli/solve/monitor.h"
#include "cli/solve/options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

struct SolveResult {
  SolveOptions options;                           ///< with the settings chosen for --max-error
  radiosity::Discretization discretization = {};  ///< with the patches as split during the solution
  radiosity::IdLayout layout = {};
  radiosity::Solution solution = {};  ///< without its patches
  double captured = 1;                ///< share of the light of a patch that the projection captures; the rest is lost
  Convergence convergence = {};
  std::optional<double> expectedError = {};  ///< with --max-error, unless a signal stopped the choice
};

/// Solves the scene as the options ask. `discretization` is that of the options; with --adaptive it is not used. The
/// solution of --edits has its continuation. After a signal the result is that of the last shot. Throws InputError if
/// --max-error cannot be reached.
SolveResult solveScene(const SolveOptions& asked, const radiosity::Scene& scene,
                       radiosity::Discretization discretization, Monitor& monitor);

}  // namespace hemitex::cli
