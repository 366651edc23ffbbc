#include "radiosity/solver/progressive_solver.h"

#include <cassert>
#include <utility>

#include "radiosity/scene/scene.h"
#include "radiosity/solver/loss_warning.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

/// Estimate of the radiosity that the unshot flux will add on average, per band, before the receiver's reflectance. The
/// flux is distributed over all surfaces and reflected infinitely often with the mean reflectance (Cohen et al. 1988).
glm::dvec3 ambientEstimate(const Scene& scene, const Discretization& discretization, const Energy& energy) {
  double area = 0;
  glm::dvec3 reflecting(0);
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    const SurfaceValues reflectance = reflectances(scene, discretization, s);
    const Grid& grid = discretization.grids[s];
    for (std::uint32_t e = grid.firstElement; e < grid.firstElement + grid.elementCount; ++e) {
      area += discretization.elements[e].area;
      reflecting += reflectance.of(e) * discretization.elements[e].area;
    }
  }
  return energy.unshot / (area - reflecting);
}

/// Limit for a warning, as a share of the emitted flux. The few pixels that see backs through cracks lose less.
constexpr double maxLostToBacks = 0.01;

std::vector<std::string> warningsOf(const Energy& energy) {
  const double emitted = bandSum(energy.emitted);
  const double lostToBacks = emitted > 0 ? bandSum(energy.lostToBacks) / emitted : 0;
  if (!(lostToBacks > maxLostToBacks)) return {};
  const int tenths = static_cast<int>(lostToBacks * 1000 + 0.5);
  return {
      std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) +
      " % of the emitted flux was absorbed by the backs of faces, which lit surfaces see. Either a face is "
      "wound clockwise as seen from its lit side, or light reaches both sides of a single sheet. Turn the face over, "
      "or give each side a surface of its own"};
}

/// Adds the flux of a patch that backs absorbed. Patches may have been split since the last call.
void addToBacks(std::vector<glm::dvec3>& absorbed, std::uint32_t patch, const glm::dvec3& flux) {
  if (patch >= absorbed.size()) absorbed.resize(patch + 1);
  absorbed[patch] += flux;
}

/// All emitted flux over the flux of a patch of weight 1.
constexpr double unitsOfFlux = 256;

/// Shoots until a limit of the settings is reached, after the shots and splits of `past`.
Solution shoot(ShootingState& state, RowCache& rows, const RowSource& rowOf, const SolverSettings& settings,
               const Progress& progress, const PatchSplit& split, const Snapshot& past = {},
               const LookAhead& lookAhead = {}) {
  Solution solution;
  solution.shots = past.shots;
  solution.absorbedByBacks = past.absorbedByBacks;
  solution.residual = state.residual();
  const auto isDone = [&] {
    return solution.residual <= settings.residual || (settings.shots && solution.shots >= *settings.shots);
  };
  std::vector<SplitCall> splits = past.splits;
  const auto snapshot = [&] { return Snapshot{solution.shots, splits, solution.absorbedByBacks, state.saved()}; };
  const double unitFlux = state.light().lastEmitted / unitsOfFlux;
  const auto weightOf = [&](std::uint32_t patch) { return bandSum(glm::abs(state.unshot(patch))) / unitFlux; };
  const auto likelyShots = [&](std::size_t count) {
    std::vector<LikelyShot> shots;
    for (const std::uint32_t patch : state.brightestPatches(count))
      if (rows.find(patch) == nullptr) shots.push_back({patch, weightOf(patch)});
    return shots;
  };
  const auto hasBeenSplit = [&](std::uint32_t patch) {
    if (!split || state.hasShot(patch)) return false;
    const double weight = weightOf(patch);
    const std::vector<std::uint32_t> parts = split(patch, weight);
    splits.push_back({patch, weight});
    if (!parts.empty()) state.split(patch, parts);
    return !parts.empty();
  };
  while (!isDone() && !solution.isInterrupted) {
    const std::uint32_t patch = state.brightestPatch();
    if (hasBeenSplit(patch)) continue;  // another patch may be brighter than the parts
    if (lookAhead) lookAhead(likelyShots);
    const FormFactorRow& row = rows.row(patch, [&] { return rowOf(patch); });
    if (row.back != 0) addToBacks(solution.absorbedByBacks, patch, state.unshot(patch) * formFactor(row.back));
    state.shoot(patch, row);
    ++solution.shots;
    solution.residual = state.residual();
    const bool goesOn = !progress || progress({solution.shots, solution.residual, isDone(), snapshot});
    solution.isInterrupted = !goesOn && !isDone();
  }
  return solution;
}

/// Splits the patches of the discretization as they were split before the snapshot.
void splitAgain(const Discretization& discretization, const Snapshot& snapshot, const PatchSplit& split) {
  for (const SplitCall& call : snapshot.splits)
    if (split && call.patch < discretization.patches.size())
      split(static_cast<std::uint32_t>(call.patch), call.weight);
    else
      throw raster::InputError("the stored solution splits other patches");
  const std::size_t patches = discretization.patches.size(), elements = discretization.elements.size();
  const SavedShots& state = snapshot.state;
  if (state.shot.size() != patches || state.unshot.size() != patches || state.received.size() != elements)
    throw raster::InputError("the stored solution has another number of patches or elements");
}

/// Completes a solution with its account of flux. A temporary state gives its memory to the radiosity.
template <typename AnyShootingState>
Solution finished(Solution solution, const Scene& scene, const Discretization& discretization,
                  AnyShootingState&& state) {
  solution.energy = state.energy();
  if (!solution.absorbedByBacks.empty()) solution.absorbedByBacks.resize(discretization.patches.size());
  solution.radiosity = std::forward<AnyShootingState>(state).radiosity();
  solution.ambient = ambientEstimate(scene, discretization, solution.energy);
  solution.warnings = warningsOf(solution.energy);
  if (const auto warning = lossWarning(scene, solution.energy)) solution.warnings.push_back(*warning);
  return solution;
}

}  // namespace

Solution solve(const Scene& scene, const Discretization& discretization, const RowSource& rowOf,
               const SolverSettings& settings, const Progress& progress, const PatchSplit& split, Start start,
               const LookAhead& lookAhead) {
  assert(!discretization.patches.empty());
  const Snapshot past = start.snapshot ? *start.snapshot : Snapshot();
  if (start.snapshot) splitAgain(discretization, past, split);
  ShootingState state = start.snapshot ? ShootingState(scene, discretization, std::move(start.outside), past.state)
                                       : ShootingState(scene, discretization, std::move(start.outside));
  RowCache rows(settings.rowCacheBytes);
  Solution solution = shoot(state, rows, rowOf, settings, progress, split, past, lookAhead);
  return finished(std::move(solution), scene, discretization, std::move(state));
}

Solution refine(const Scene& scene, const Discretization& discretization, ShootingState& state, RowCache& rows,
                const RowSource& rowOf, const SolverSettings& settings, const Progress& progress,
                const PatchSplit& split) {
  Solution solution = shoot(state, rows, rowOf, settings, progress, split);
  return finished(std::move(solution), scene, discretization, std::as_const(state));
}

}  // namespace hemitex::radiosity
