/// Dynamic scenes: updates a solution after edits of its scene instead of solving again (Chen 1990; George, Sillion and
/// Greenberg 1990).
///
/// The stored shots define the changes (shooting_state.h). A new emission or reflectance takes effect immediately,
/// because each element stores what it received. If objects were added, removed or moved, light that was shot reaches
/// other elements. For each patch, the change is its shot light times the change of its row (row_update.h); it is
/// negative where light no longer arrives. Shots of moved patches are retracted, and their light is unshot again. Then
/// unshot flux of either sign is shot until the residual is reached.
///
/// Patches keep their old rows if little of their light can pass through the changed pixels. A bound of this stale
/// light is part of the residual. So the residual keeps its meaning: the absorbed flux differs from a new solution of
/// the edited scene with the same patches by at most the sum of both residuals.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/row_cache.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/solver/shooting_state.h"

namespace hemitex::radiosity {

/// Lays out the item IDs of a discretization; throws InputError if they do not fit.
using LayoutFactory = std::function<IdLayout(const Discretization&)>;

struct DynamicSettings {
  DiscretizationSettings discretization = {};
  DrawingSettings drawing = {};
  SolverSettings solver = {};
  OtherRows rows = {};  ///< empty: rows are drawn
};

/// The work of an update, except for its shots.
struct UpdateCost {
  int rowsInWindows = 0;     ///< rows of which only windows were drawn
  int rowsWhole = 0;         ///< rows that were drawn completely, before and after the edit
  int rowsRetracted = 0;     ///< retracted rows, of patches that moved or were removed
  int rowsLeft = 0;          ///< stale rows, whose bound is part of the residual
  bool startedOver = false;  ///< solved again: too much stale light, too little emission to allow for it, or objects
                             ///< have changed and their rows are not drawn with index maps
};

/// As SceneFormFactors::row. Draws only the views whose rows are not in the cache, and keeps there those of patches
/// with several points and of patches whose row is corrected. With it `solve` gives the continuation `rows.ofViews`,
/// which save work at the first update.
FormFactorRow rowByViews(SceneFormFactors& drawn, RowCache& ofViews, const Patch& patch);

/// A scene and what draws its rows.
struct DrawnScene {
  DrawnScene(Scene ofWorld, Discretization shooting, const LayoutFactory& layOut, const DrawingSettings& settings,
             const RendererFactory& makeRenderer)
      : scene(std::move(ofWorld)),
        discretization(std::move(shooting)),
        drawn(scene, discretization, layOut(discretization), settings, makeRenderer) {}

  const Scene scene;
  Discretization discretization;
  SceneFormFactors drawn;
};

class DynamicSolution {
 public:
  /// Starts from a solution of the scene with the drawing and solver settings, with its continuation.
  /// `discretization` is that of the scene, with the patches of the solution. Its settings should be unburied;
  /// otherwise surfaces under moved solids would stay dark.
  DynamicSolution(Scene scene, Discretization discretization, Solution solution, DynamicSettings settings,
                  LayoutFactory layOut, RendererFactory makeRenderer = softwareRenderer);

  /// Edits the scene and updates the solution; counts shots from here. With a snapshot of the same update goes on from
  /// there. Throws InputError as `edited` and the layout, and then changes nothing; for a snapshot of another solution
  /// the object must not be used afterwards.
  UpdateCost update(std::span<const Edit> edits, const Progress& progress = {}, const Snapshot* snapshot = nullptr);
  /// As update, for an edit of scene().
  UpdateCost updateTo(EditedScene edit, const Progress& progress = {}, const Snapshot* snapshot = nullptr);

  const Scene& scene() const { return world_->scene; }
  /// Its patches are those of the solution.
  const Discretization& discretization() const { return world_->discretization; }
  const IdLayout& layout() const { return world_->drawn.layout(); }
  /// The solution; its patches are in the discretization.
  const Solution& solution() const { return solution_; }
  /// The flux that was shot, and where it arrived.
  const ShotLight& light() const { return solution_.continuation->light; }

 private:
  DynamicSettings settings_;
  LayoutFactory layOut_;
  RendererFactory makeRenderer_;
  std::unique_ptr<DrawnScene> world_;
  std::vector<Surface> removed_;
  KeptRows rows_;
  Solution solution_;
};

}  // namespace hemitex::radiosity
