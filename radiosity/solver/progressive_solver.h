/// Progressive refinement (Cohen, Chen, Wallace and Greenberg 1988): shoots the patch with the most unshot flux until
/// little is left. All flux is accounted for: emitted = absorbed + unshot + lost (see shooting_state.h).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/patch_rows.h"
#include "radiosity/form_factors/row_cache.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/shooting_state.h"
#include "radiosity/solver/snapshot.h"

namespace hemitex::radiosity {

struct SolverSettings {
  double residual = 0.001;        ///< stops when unshot over emitted flux, bands summed, is at most this; >= 0.
                                  ///< If surfaces are seen, see also SeenLight::residual
  std::optional<int> shots = {};  ///< maximum number of shots; >= 0
  std::size_t rowCacheBytes = std::size_t{1024}
                              << 20;  ///< memory of the cache of rows, for later shots of the same patch
  bool keepsIrradiance = false;       ///< also for scenes without maps (see Solution::irradiance)
};

/// The residual for a scene: that of SolverSettings, times the share of all emitted flux that counts. Light from
/// outside counts as OutsideFlux::counted, so that a room behind windows is as accurate as one with lamps.
double defaultResidual(const Scene& scene, const Discretization& discretization, const OutsideFlux& outside);

/// The light of seen surfaces (see seenSurfaces). The solution takes as much care of it as of all light: little of it
/// stays unshot. With scout rows, patches are split and drawn by what their flux adds to it, even if they are faint
/// among all patches.
struct SeenLight {
  std::vector<bool> surfaces = {};  ///< whether they are seen, one per surface; empty if none is
  RowSource scoutRow = {};          ///< see SceneFormFactors::scoutRows
  double residual = 0.005;          ///< the solution goes on while ShootingState::seenResidual is above this; if no
                                    ///< light comes, to a millionth of the residual of the settings
};

/// All that a solution is computed from. What it refers to must not change during the solution.
struct SolveInput {
  const Scene& scene;
  const Discretization& discretization;  ///< of which `patches` are used instead of its own
  Patches patches;                       ///< at least one
  RowSource rowOf;
  PatchSplit split = {};                                    ///< see PatchRows
  std::function<void(const NextShots& next)> prepare = {};  ///< see PatchRows
  SolverSettings settings = {};
  OutsideFlux outside = {};  ///< light from outside the scene
  SeenLight seen = {};
  const Snapshot* snapshot = nullptr;  ///< goes on from here; all else must be that of the solution that it is of
  bool isContinued = false;            ///< see Solution::continuation
};

/// What `refine` continues from.
struct Continuation {
  ShotLight light;
  KeptRows rows;  ///< each cache with half the memory of the settings; `solve` leaves `ofViews` empty
};

struct SolutionWarning {
  std::string text;
  bool isAboutBacks = false;  ///< surfaces with two sides may be the remedy

  bool operator==(const SolutionWarning&) const = default;
};

/// Colours are linear sRGB (see colour.h): in a scene with wavelengths those of its bands, with negative channels
/// outside sRGB.
struct Solution {
  std::vector<glm::dvec3> radiosity;  ///< one per element, W/m^2, without the ambient estimate
  BandTable radiosityInBands = {};    ///< in a scene with wavelengths: the same in its bands
  /// One per element, W/m^2: the flux that it received, over its area. At wavelengths that which, reflected by the
  /// colour of the element, gives its radiosity. Empty if no surface has a map and the settings do not keep it.
  std::vector<glm::dvec3> irradiance = {};
  glm::dvec3 ambient{0.0};  ///< ambient radiosity of the unshot flux; times reflectance it is added only for display
  Energy energy = {};
  Patches patches = {};  ///< as split during the solution
  /// One per patch: the flux that it shot in this solution and that backs absorbed. Empty if there is none.
  std::vector<glm::dvec3> absorbedByBacks = {};
  double residual = 0;  ///< unshot over emitted flux, bands summed (see ShootingState::residual)
  int shots = 0;
  bool isInterrupted = false;  ///< ended by Progress before a limit was reached
  std::vector<SolutionWarning> warnings = {};
  std::optional<Continuation> continuation = {};  ///< if SolveInput::isContinued
};

/// A solution after a shot.
struct Step {
  int shots = 0;
  double residual = 0;
  bool isLast = false;                 ///< a limit of the settings is reached
  std::function<Snapshot()> snapshot;  ///< from which `solve` goes on
};

/// Called after each shot. The solution ends there if it returns false.
using Progress = std::function<bool(const Step&)>;

/// What ended a solution with these settings: `progress`, `shots` or `residual`.
std::string endOf(const Solution& solution, const SolverSettings& settings);

/// Starts from the emission of the elements and the light from outside, and shoots until a limit of the settings is
/// reached. The result does not depend on the number of threads, on the memory of the row cache, or on snapshots.
/// Throws InputError for a snapshot of another solution.
Solution solve(SolveInput input, const Progress& progress = {});

/// As above from light that was shot by the patches of the input. Counts shots from here; the outside flux of the input
/// is not used.
Solution refine(SolveInput input, Continuation past, const Progress& progress = {});

}  // namespace hemitex::radiosity
