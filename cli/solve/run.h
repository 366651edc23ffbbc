/// The computation of `hemitex solve`: solves the scene, and chooses elements or settings by solutions.
#pragma once

#include "cli/report/solved_page.h"
#include "cli/solve/monitor.h"
#include "cli/solve/options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/light/light.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "reference/rows/solution_rows.h"

namespace hemitex::cli {

struct SolveResult {
  SolveOptions options;  ///< with the settings chosen for --max-error
  radiosity::Light light = {};
  Convergence convergence = {};
  /// With facets and --max-error: the estimated error of the row of each surface; 0 if it did not shoot.
  std::vector<double> rowErrors = {};
};

/// Throws InputError, with the number, if the pictures of the result could not be written, or if the program, the
/// scene, its elements and the rows that the cache may hold do not fit into the free memory (see
/// raster/base/memory_budget.h). docs/performance.md states how the bytes of each were measured.
void requireMemoryOfRun(const radiosity::Scene& scene, const SolveOptions& options);

/// Layouts as `layoutOf`, and the rows of the method of the options. With bounded errors these are set. Throws
/// InputError as matrixRows.
radiosity::LightHooks hooksOf(const SolveOptions& options, const reference::RowErrors& errors);

/// Solves the scene as the options ask. With --max-error the seen surfaces are those that `camera` shows.
/// `discretization` is that of the options; with --adaptive it is not used. The solution of --edits has its
/// continuation. After a signal the result is that of
/// the last shot. Throws InputError if --max-error cannot be reached.
SolveResult solveScene(const SolveOptions& asked, const radiosity::Scene& scene, const radiosity::Camera& camera,
                       radiosity::Discretization discretization, Monitor& monitor);

}  // namespace hemitex::cli
