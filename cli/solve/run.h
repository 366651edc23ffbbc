/// The computation of `hemitex solve`: discretizes the scene, solves it, and chooses settings for a bound on the error.
#pragma once

#include <memory>
#include <optional>

#include "cli/common/console.h"
#include "cli/solve/options.h"
#include "cli/view/solved_page.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/dynamic_solution.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

/// The discretization by texels, or by quadtrees that are refined with solutions.
radiosity::Discretization discretizationFor(const SolveOptions& options, const radiosity::Scene& scene,
                                            Console& console);

/// A solution and its discretization, with patches as split during the solution.
struct Solved {
  radiosity::Discretization discretization;
  radiosity::Solution solution;
  double captured = 1;  ///< share of the light of a patch that the projection captures; the rest is lost
  Convergence convergence = {};
};

/// Solves the scene.
Solved solvedBy(const SolveOptions& options, const radiosity::Scene& scene, radiosity::Discretization discretization,
                const radiosity::IdLayout& layout, Console& console);

/// A solution within a bound on the error, with the settings chosen for it.
struct BoundedSolution {
  SolveOptions options;
  Solved solved = {};
  double expectedError = 0;
};

/// Solves within --max-error; nothing if the option is not given. Throws InputError if the bound cannot be reached.
std::optional<BoundedSolution> solvedWithin(const SolveOptions& asked, const radiosity::Scene& scene,
                                            const radiosity::Discretization& discretization,
                                            const radiosity::IdLayout& layout, Console& console);

/// Solves the scene for later edits, and records the convergence of this first solution. `options` and `console` must
/// outlive the result.
std::unique_ptr<radiosity::DynamicSolution> dynamicSolution(const SolveOptions& options, const radiosity::Scene& scene,
                                                            radiosity::Discretization discretization,
                                                            Convergence& convergence, Console& console);
/// The current state of a dynamic solution.
Solved solvedBy(const radiosity::DynamicSolution& dynamic);

/// Shows the progress of a solution: the share of the requested shots, or of the residual's decrease on a logarithmic
/// scale. Both arguments must outlive the result.
radiosity::Progress progressOf(const radiosity::SolverSettings& settings, Console& console);

/// As `progress`, and adds each shot to `convergence`. The time starts now.
radiosity::Progress recording(Convergence& convergence, radiosity::Progress progress);

}  // namespace hemitex::cli
