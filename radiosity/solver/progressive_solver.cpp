#include "radiosity/solver/progressive_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

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
    for (const std::uint32_t e : elementsOf(grid)) {
      area += discretization.elements[e].area;
      reflecting += reflectance.of(e) * discretization.elements[e].area;
    }
  }
  return energy.unshot / (area - reflecting);
}

/// Limit for a warning, as a share of the emitted flux. The few pixels that see backs through cracks lose less.
constexpr double maxLostToBacks = 0.01;

std::vector<SolutionWarning> warningsOf(const Scene& scene, const Energy& energy) {
  const double emitted = bandSum(energy.emitted);
  const double lostToBacks = emitted > 0 ? bandSum(energy.lostToBacks) / emitted : 0;
  std::vector<SolutionWarning> warnings;
  if (lostToBacks > maxLostToBacks) {
    const int tenths = static_cast<int>(lostToBacks * 1000 + 0.5);
    warnings.push_back(
        {std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) +
             " % of the emitted flux was absorbed by the backs of faces, which lit surfaces see. Either a face is "
             "wound clockwise as seen from its lit side, or light reaches both sides of a single sheet. Turn the face "
             "over, or give each side a surface of its own",
         true});
  }
  if (const auto loss = lossWarning(scene, energy)) warnings.push_back({*loss});
  return warnings;
}

/// All emitted flux over the flux of a patch of weight 1 (see PatchSplit).
constexpr double unitsOfFlux = 256;

/// The flux of a patch of weight 1, of which light from outside counts as outsideShare.
double unitFluxOf(const ShotLight& light) {
  return (light.lastEmitted - (1 - outsideShare) * bandSum(sumOf(light.outside))) / unitsOfFlux;
}

/// Shoots until a limit of the settings is reached, after the shots and splits of `past`.
Solution shoot(const SolveInput& input, ShootingState& state, RowCache& rows, const Progress& progress,
               const Snapshot& past = {}) {
  const SolverSettings& settings = input.settings;
  state.setSeen(input.seen.surfaces);
  Solution solution;
  solution.shots = past.shots;
  solution.absorbedByBacks = past.absorbedByBacks;
  solution.residual = state.residual();
  const auto isDone = [&] {
    return (settings.shots && solution.shots >= *settings.shots) ||
           (solution.residual <= settings.residual && state.seenResidual() <= settings.residual);
  };
  std::vector<SplitCall> splits = past.splits;
  const auto snapshot = [&] { return Snapshot{solution.shots, splits, solution.absorbedByBacks, state.saved()}; };
  const double unitFlux = unitFluxOf(state.light());
  const auto weightOf = [&](std::uint32_t number) {
    const Patch& patch = state.patches().list[number];
    const double ofAll = bandSum(glm::abs(state.unshot(number))) / unitFlux;
    if (input.seen.surfaces.empty() || !input.seen.scoutRow || patch.isSettled) return ofAll;
    const double ofSeen = unitsOfFlux * state.seenGain(number, input.seen.scoutRow(patch));
    return std::max(ofAll, ofSeen);
  };
  const auto likelyShots = [&](std::size_t count) {
    std::vector<LikelyShot> shots;
    for (const std::uint32_t patch : state.brightestPatches(count))
      if (rows.find(patch) == nullptr) shots.push_back({patch, weightOf(patch)});
    return shots;
  };
  const auto hasBeenSplit = [&](std::uint32_t number) {
    const Patch& patch = state.patches().list[number];
    if (!input.split || patch.isSettled || state.hasShot(number)) return false;
    splits.push_back({number, weightOf(number)});
    std::vector<Patch> parts = input.split(state.patches(), patch, splits.back().weight);
    const bool isOne = parts.size() == 1;
    state.split(number, std::move(parts));
    return !isOne;
  };
  while (!isDone() && !solution.isInterrupted) {
    const std::uint32_t patch = state.brightestPatch();
    if (hasBeenSplit(patch)) continue;  // another patch may be brighter than the parts
    const FormFactorRow& row = rows.row(patch, [&] { return input.rowOf(state.patches().list[patch]); });
    if (row.back != 0) {
      std::vector<glm::dvec3>& absorbed = solution.absorbedByBacks;
      absorbed.resize(std::max(absorbed.size(), std::size_t{patch} + 1));
      absorbed[patch] += state.unshot(patch) * formFactor(row.back);
    }
    state.shoot(patch, row);
    ++solution.shots;
    solution.residual = state.residual();
    const bool goesOn =
        !progress || progress({solution.shots, solution.residual, isDone(), state.patches(), snapshot, likelyShots});
    solution.isInterrupted = !goesOn && !isDone();
  }
  return solution;
}

/// Splits the patches as they were split before the snapshot.
void splitAgain(SolveInput& input, const Snapshot& snapshot) {
  Patches& patches = input.patches;
  for (const SplitCall& call : snapshot.splits) {
    if (!input.split || call.patch >= patches.list.size() || !(call.weight >= 0) || std::isinf(call.weight))
      throw raster::InputError("the stored solution splits other patches");
    const auto number = static_cast<std::uint32_t>(call.patch);
    replacePatch(patches, number, input.split(patches, patches.list[number], call.weight));
  }
  const std::size_t count = patches.list.size(), elements = patches.ofElement.size();
  const SavedShots& state = snapshot.state;
  if (state.shot.size() != count || state.unshot.size() != count || state.received.size() != elements)
    throw raster::InputError("the stored solution has another number of patches or elements");
}

bool areFluxes(const std::vector<glm::dvec3>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](const glm::dvec3& flux) { return flux.x >= 0 && flux.y >= 0 && flux.z >= 0; });
}

/// Throws InputError for a stored solution with values that no solution of the scene has: negative flux, or flux that
/// came from nowhere.
void requireBalanced(const ShootingState& state, const Snapshot& snapshot) {
  constexpr double tolerance = 1e-6;  // sums of a solution balance to 1e-12
  const Energy energy = state.energy();
  const double emitted = bandSum(energy.emitted);
  const double missing = bandSum(glm::abs(energy.emitted - energy.absorbed - energy.unshot - energy.lost));
  const bool areSizes = snapshot.shots >= 0 && snapshot.absorbedByBacks.size() <= state.patches().list.size();
  const glm::dvec3 rounding(tolerance * emitted);
  const bool areLosses = areFluxes({energy.lostToBacks + rounding, energy.lost - energy.lostToBacks + rounding});
  if (!areSizes || !areLosses || !(missing <= tolerance * emitted) || !areFluxes(snapshot.state.shot) ||
      !areFluxes(snapshot.state.received) || !areFluxes(snapshot.state.unshot) || !areFluxes(snapshot.absorbedByBacks))
    throw raster::InputError("the stored solution does not balance: it is not one of this scene");
}

/// Completes a solution with its account of flux and its patches.
Solution finished(const SolveInput& input, Solution solution, ShootingState state, KeptRows rows) {
  solution.energy = state.energy();
  if (!solution.absorbedByBacks.empty()) solution.absorbedByBacks.resize(state.patches().list.size());
  solution.ambient = ambientEstimate(input.scene, input.discretization, solution.energy);
  solution.warnings = warningsOf(input.scene, solution.energy);
  if (input.isContinued) solution.continuation = Continuation{state.light(), std::move(rows)};
  solution.patches = state.takePatches();
  if (hasMaps(input.scene) || input.settings.keepsIrradiance) solution.irradiance = state.irradiance();
  solution.radiosity = std::move(state).radiosity();
  return solution;
}

}  // namespace

double defaultResidual(const Scene& scene) {
  constexpr double withoutOutside = SolverSettings().residual;
  return brightest(scene.outside) > 0 ? withoutOutside * outsideShare : withoutOutside;
}

Solution solve(SolveInput input, const Progress& progress) {
  assert(!input.patches.list.empty());
  const Snapshot past = input.snapshot ? *input.snapshot : Snapshot();
  if (input.snapshot) splitAgain(input, past);
  const Scene& scene = input.scene;
  const Discretization& discretization = input.discretization;
  ShotLight nothing = input.snapshot ? ShotLight() : nothingShot(input.patches, std::move(input.outside));
  ShootingState state =
      input.snapshot
          ? ShootingState(scene, discretization, std::move(input.patches), std::move(input.outside), past.state)
          : ShootingState(scene, discretization, std::move(input.patches), std::move(nothing));
  if (input.snapshot) requireBalanced(state, past);
  const std::size_t bytes = input.settings.rowCacheBytes;
  KeptRows rows{RowCache(input.isContinued ? bytes / 2 : bytes), RowCache(bytes / 2)};
  Solution solution = shoot(input, state, input.rows != nullptr ? *input.rows : rows.ofPatches, progress, past);
  return finished(input, std::move(solution), std::move(state), std::move(rows));
}

Solution refine(SolveInput input, Continuation past, const Progress& progress) {
  ShootingState state(input.scene, input.discretization, std::move(input.patches), std::move(past.light));
  Solution solution = shoot(input, state, input.rows != nullptr ? *input.rows : past.rows.ofPatches, progress);
  return finished(input, std::move(solution), std::move(state), std::move(past.rows));
}

}  // namespace hemitex::radiosity
