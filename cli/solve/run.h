/// What `hemitex solve` does between reading a scene and writing it lit: settings are chosen where a bound on the error
/// asks for that, surfaces become elements, patches shoot.
#pragma once

#include <memory>
#include <optional>

#include "cli/common/console.h"
#include "cli/solve/options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/dynamic_solution.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

/// Elements: texels, or leaves of quadtrees that solutions have refined.
radiosity::Discretization discretizationFor(const SolveOptions& options, const radiosity::Scene& scene,
                                            Console& console);

/// A solution, and the discretization whose patches shot.
struct Solved {
  radiosity::Discretization discretization;
  radiosity::Solution solution;
  double captured = 1;  ///< of the light that leaves a patch, by what finds rows; the rest is lost
};

Solved solvedBy(const SolveOptions& options, const radiosity::Scene& scene, radiosity::Discretization discretization,
                const radiosity::IdLayout& layout, Console& console);

/// A solution within a bound on the error, and the settings that were chosen for it.
struct BoundedSolution {
  SolveOptions options;
  Solved solved = {};
  double expectedError = 0;
};

/// Where a bound on the error was asked for: settings are chosen so that the solution keeps it.
std::optional<BoundedSolution> solvedWithin(const SolveOptions& asked, const radiosity::Scene& scene,
                                            const radiosity::Discretization& discretization,
                                            const radiosity::IdLayout& layout, Console& console);

/// A solution that follows edits, and what it is before the first of them. `options` and `console` outlive it.
std::unique_ptr<radiosity::DynamicSolution> dynamicSolution(const SolveOptions& options, const radiosity::Scene& scene,
                                                            radiosity::Discretization discretization, Console& console);
Solved solvedBy(const radiosity::DynamicSolution& dynamic);

/// How far the solution is: shots done of those asked for, or the residual's way down, on a logarithmic scale. Both
/// arguments outlive it.
radiosity::Progress progressOf(const radiosity::SolverSettings& settings, Console& console);

}  // namespace hemitex::cli
