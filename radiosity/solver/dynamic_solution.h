/// Dynamic scenes: a solution that follows the edits of its scene instead of starting over (Chen 1990; George, Sillion
/// and Greenberg 1990).
///
/// What was shot says what changes (shooting_state.h). A new emission or reflectance is there at once, for each element
/// keeps what it received. Where objects came, went or moved, the light that patches have shot goes elsewhere: for each
/// patch the light times what of its row changed (row_update.h), below zero where it no longer arrives. What moved
/// patches themselves have shot is taken back, and unshot again. What is unshot then, of either sign, is shot until no
/// more than the residual is left.
///
/// Patches whose light through the pixels in question cannot amount to much keep their old rows: what may lie astray
/// for it is bounded and part of the residual, so that this holds its promise: what elements absorb differs from a
/// fresh solution of the edited scene, with the same patches, by no more than both residuals.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
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

/// Lays out the item IDs of a discretization; throws InputError where they do not fit.
using LayoutFactory = std::function<IdLayout(const Discretization&)>;

struct DynamicSettings {
  DiscretizationSettings discretization = {};
  DrawingSettings drawing = {};
  SolverSettings solver = {};
};

/// What an update took, beside its shots.
struct UpdateCost {
  int rowsInWindows = 0;     ///< rows of which only windows were drawn
  int rowsWhole = 0;         ///< rows that were drawn whole before and after
  int rowsTakenBack = 0;     ///< rows of patches that moved or went
  int rowsLeft = 0;          ///< rows that are not brought up to date: what they amount to is part of the residual
  bool startedOver = false;  ///< too much of the light lay astray, or too little is emitted now to allow for it
};

/// Rows of patches, and those of the views that means are over: windows change these exactly, and the means of what
/// they are then are the means that drawing all anew would give.
struct KeptRows {
  /// Each takes half of `budget`, in bytes.
  explicit KeptRows(std::size_t budget) : ofPatches(budget / 2), ofViews(budget / 2) {}

  RowCache ofPatches;
  RowCache ofViews;  ///< by the numbers of views
};

class DynamicSolution {
 public:
  /// Solves the scene. `unsplit` is its discretization by the settings, which are to be unburied: what solids bury
  /// would be as dark as before where they have moved away.
  DynamicSolution(Scene scene, Discretization unsplit, DynamicSettings settings, LayoutFactory layOut,
                  const Progress& progress = {}, RendererFactory makeRenderer = softwareRenderer);
  ~DynamicSolution();
  DynamicSolution(const DynamicSolution&) = delete;
  DynamicSolution& operator=(const DynamicSolution&) = delete;

  /// Edits the scene and updates the solution, whose shots are counted from here. Throws InputError as `edited` and the
  /// layout do; nothing has changed then.
  UpdateCost update(std::span<const Edit> edits, const Progress& progress = {});

  const Scene& scene() const;
  const Discretization& discretization() const;
  const IdLayout& layout() const;
  /// The share of a patch's light that the projection captures, in units of 2^-60.
  std::uint64_t captured() const;
  const Solution& solution() const { return solution_; }
  /// What was shot, and where it arrived.
  const ShotLight& light() const { return light_; }

 private:
  struct World;

  FormFactorRow rowOf(std::uint32_t patch);
  void refine(ShootingState state, const Progress& progress);

  DynamicSettings settings_;
  LayoutFactory layOut_;
  RendererFactory makeRenderer_;
  std::unique_ptr<World> world_;
  std::vector<Surface> removed_;
  KeptRows rows_;
  ShotLight light_;
  Solution solution_;
};

}  // namespace hemitex::radiosity
