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
#include "radiosity/form_factors/patch_subdivision.h"
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

/// The share of light from outside that counts in the default residual and in the weights of patches (see
/// patch_subdivision.h). A room behind windows receives about this share of the light on a house and the ground around
/// it, and should be as accurate as a room with lamps.
inline constexpr double outsideShare = 0.01;

/// The residual for a scene: that of SolverSettings, times outsideShare if light comes from outside.
double defaultResidual(const Scene& scene);

/// The light of seen surfaces (see seenSurfaces). The solution takes as much care of it as of all light: little of it
/// stays unshot. With scout rows, patches are split and drawn by what their flux adds to it, even if they are faint
/// among all patches.
struct SeenLight {
  std::vector<bool> surfaces = {};  ///< whether they are seen, one per surface; empty if none is
  RowSource scoutRow = {};          ///< see SceneFormFactors::scoutRows
  double residual = 0.02;           ///< the solution goes on while ShootingState::seenResidual is above this; if no
                                    ///< light comes, to a millionth of the residual of the settings
};

/// All that a solution is computed from. What it refers to must not change during the solution.
struct SolveInput {
  const Scene& scene;
  const Discretization& discretization;  ///< of which `patches` are used instead of its own
  Patches patches;                       ///< at least one
  RowSource rowOf;
  PatchSplit split = {};  ///< without it no patch is split
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

/// A patch that will probably shoot soon, and its weight (see PatchSplit) if it shot now.
struct LikelyShot {
  std::uint32_t patch = 0;
  double weight = 0;
};

/// A solution after a shot.
struct Step {
  int shots = 0;
  double residual = 0;
  bool isLast = false;  ///< a limit of the settings is reached
  const Patches& patches;
  std::function<Snapshot()> snapshot;  ///< from which `solve` goes on
  /// Likely shots, the one with the most flux first: at most `count`, without those whose rows are in the cache.
  std::function<std::vector<LikelyShot>(std::size_t count)> likelyShots;
};

/// The rows of a solution, and the patches that they are of.
struct PatchRows {
  RowSource rowOf;
  PatchSplit split = {};                               ///< see SolveInput
  double captured = 1;                                 ///< share of a patch's light that rows hold; the rest is lost
  std::function<void(const Step& step)> prepare = {};  ///< called after each shot: computes rows of likely shots
};

/// Gives other rows than those that are drawn, or goes around these. The arguments outlive the rows.
using OtherRows = std::function<PatchRows(PatchRows drawn, const Scene& scene, const Discretization& discretization)>;

/// Called after each shot. The solution ends there if it returns false.
using Progress = std::function<bool(const Step&)>;

/// A progress that first computes the rows of likely shots. Both arguments must outlive it.
Progress preparing(const PatchRows& rows, const Progress& progress);

/// Starts from the emission of the elements and the light from outside, and shoots until a limit of the settings is
/// reached. The result does not depend on the number of threads, on the memory of the row cache, or on snapshots.
/// Throws InputError for a snapshot of another solution.
Solution solve(SolveInput input, const Progress& progress = {});

/// As above from light that was shot by the patches of the input. Counts shots from here; the outside flux of the input
/// is not used.
Solution refine(SolveInput input, Continuation past, const Progress& progress = {});

}  // namespace hemitex::radiosity
