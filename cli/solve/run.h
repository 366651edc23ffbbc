/// The computation of `hemitex solve`: solves the scene, and chooses elements or settings by solutions.
#pragma once

#include <optional>

#include "cli/report/solved_page.h"
#include "cli/solve/band_scenes.h"
#include "cli/solve/monitor.h"
#include "cli/solve/options.h"
#include "radiosity/bands/colour_solution.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/error_control.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

struct SolveResult {
  SolveOptions options;                           ///< with the settings chosen for --max-error
  radiosity::Discretization discretization = {};  ///< with the patches as split during the solution
  radiosity::IdLayout layout = {};
  radiosity::Solution solution = {};  ///< without its patches
  double captured = 1;                ///< share of the light of a patch that the projection captures; the rest is lost
  Convergence convergence = {};
  /// With --max-error, unless a signal stopped the choice.
  std::optional<radiosity::LightErrors> expectedErrors = {};
  /// With facets and --max-error: the estimated error of the row of each surface; 0 if it did not shoot.
  std::vector<double> rowErrors = {};
  std::optional<radiosity::BandSolution> bands = {};  ///< of which `solution` is the colour, with --bands
};

/// Solves the scene as the options ask. With --max-error the seen surfaces are those that `camera` shows.
/// `discretization` is that of the options; with --adaptive it is not used. The solution of --edits has its
/// continuation. After a signal the result is that of the last shot. Throws InputError if
/// --max-error cannot be reached.
SolveResult solveScene(const SolveOptions& asked, const radiosity::Scene& scene, const radiosity::Camera& camera,
                       radiosity::Discretization discretization, Monitor& monitor);

/// As above in bands, without a choice of elements or settings.
SolveResult solveBands(const SolveOptions& asked, const BandScenes& scenes, radiosity::Discretization discretization,
                       Monitor& monitor);

}  // namespace hemitex::cli
