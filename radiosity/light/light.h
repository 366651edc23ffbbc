/// The light of a scene, in one call: draws the rows of its patches, shoots, and chooses elements or effort if asked.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/rows_ahead.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/ranks/messenger.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/dynamic_solution.h"
#include "radiosity/solver/error_control.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::radiosity {

struct LightSettings {
  DrawingSettings drawing = {};
  SolverSettings solver = {};
  bool isResidualDefault = false;  ///< without maxError: the residual of `solver` becomes the default of the scene
  /// Above 0. Solves with growing effort until both expected errors are within it (error_control.h): chooses the
  /// resolution and the splits of `drawing`, and the residual of `solver`. A solution that the shots of `solver` end is
  /// the last one.
  std::optional<double> maxError = {};
  Effort coarsest = EffortLimits().coarsest;  ///< with maxError: where the effort begins
  std::optional<double> residual = {};        ///< with maxError: the residual is at most this
  std::vector<bool> seen = {};  ///< whether surfaces are seen, whose light decides with all light; see SeenLight
  /// Above 0. Splits elements where radiosity changes by more than this share (adaptive_subdivision.h).
  std::optional<double> adaptive = {};
  DiscretizationSettings elements = {};  ///< of adaptive elements, and of those that edits add
  bool isContinued = false;              ///< keeps what edits go on from (see editable); rows of views are kept, too
};

/// How a solution starts, and who follows it.
struct SolutionStart {
  std::optional<Snapshot> snapshot = {};  ///< goes on from here
  Progress progress = {};
};

/// What callers change of the computation.
struct LightHooks {
  LayoutFactory layOut = [](const Discretization& discretization) { return radiosity::layOut(discretization); };
  RendererFactory makeRenderer = softwareRenderer;
  /// Called at the start of each solution; a choice of elements or effort has several. The settings outlive it.
  std::function<SolutionStart(const SolverSettings& settings)> start = {};
  OtherRows rows = {};
  /// Finds a solution in another way than `solve`.
  std::function<Solution(SolveInput input)> solve = {};
  Messenger* ranks = nullptr;  ///< the ranks that share drawn rows; null if this process is alone
};

struct Light {
  LightSettings settings;              ///< with what was chosen
  Discretization discretization = {};  ///< with the patches as split during the solution
  IdLayout layout = {};
  Solution solution = {};                          ///< without its patches
  double captured = 1;                             ///< see PatchRows
  std::optional<LightErrors> expectedErrors = {};  ///< with maxError, if two solutions were compared
  std::optional<RowCounts> rowsAhead = {};         ///< of the last solution, with ranks
};

/// Solves a scene with elements, which adaptive ones replace; with both, the error on adaptive elements is bounded. If
/// the progress ends a solution, the result is that of its last shot. With several ranks all call this; ranks other
/// than 0 compute rows, and their result has no light. Throws InputError as `solve`, as chooseEffort and as
/// discretize, and for maxError without hemicubes.
Light light(const Scene& scene, Discretization discretization, const LightSettings& settings = {},
            const LightHooks& hooks = {});

/// A solution that follows edits of its scene. `light` was solved with isContinued.
DynamicSolution editable(Scene scene, Light light, const LightHooks& hooks = {});

}  // namespace hemitex::radiosity
