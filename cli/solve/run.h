/// The computation of `hemitex solve`: solves the scene, and chooses elements or settings by solutions.
#pragma once

#include <memory>
#include <optional>

#include "cli/report/solved_page.h"
#include "cli/solve/monitor.h"
#include "cli/solve/options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/dynamic_solution.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

/// A solution and its discretization, with patches as split during the solution.
struct Solved {
  radiosity::Discretization discretization = {};
  radiosity::Solution solution = {};
  double captured = 1;  ///< share of the light of a patch that the projection captures; the rest is lost
  Convergence convergence = {};
};

struct Outcome {
  SolveOptions options;  ///< with the settings chosen for --max-error
  radiosity::IdLayout layout = {};
  Solved solved = {};
  std::optional<double> expectedError = {};                  ///< with --max-error, unless a signal stopped the choice
  std::unique_ptr<radiosity::DynamicSolution> dynamic = {};  ///< with --edits; `solved` is its first state
};

/// Solves the scene as the options ask. `discretization` is that of the options; with --adaptive it is not used. The
/// other arguments must outlive the result. After a signal the outcome is that of the last shot. Throws InputError if
/// --max-error cannot be reached.
Outcome solveScene(const SolveOptions& asked, const radiosity::Scene& scene, radiosity::Discretization discretization,
                   Monitor& monitor);

}  // namespace hemitex::cli
