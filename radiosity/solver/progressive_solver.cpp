#include "radiosity/solver/progressive_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "radiosity/solver/loss_warning.h"
#include "radiosity/spectra/colour.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

/// Estimate of the radiosity that the unshot flux will add on average, per band, before the receiver's reflectance. The
/// flux is distributed over all surfaces and reflected infinitely often with the mean reflectance (Cohen et al. 1988).
Bands ambientEstimate(const Discretization& discretization, const ElementMaterials& materials, const Energy& energy) {
  double area = 0;
  Bands reflecting(materials.bands());
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    for (const std::uint32_t e : elementsOf(discretization.grids[s])) {
      area += discretization.elements[e].area;
      addTo(reflecting, materials.reflectance(s, e), discretization.elements[e].area);
    }
  }
  Bands ambient = energy.unshot;
  for (std::size_t band = 0; band < ambient.size(); ++band) ambient[band] /= area - reflecting[band];
  return ambient;
}

/// The irradiance of all elements whose reflection gives their colours.
std::vector<glm::dvec3> irradianceOf(const SolveInput& input, const std::vector<glm::dvec3>& radiosity) {
  std::vector<glm::dvec3> irradiance;
  for (std::uint32_t e = 0; e < radiosity.size(); ++e)
    irradiance.push_back(irradianceFor(radiosity[e], emission(input.scene, input.discretization, e),
                                       reflectance(input.scene, input.discretization, e)));
  return irradiance;
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

/// The flux that counts of all that is emitted, bands summed: light from outside in part.
double countedFlux(double emitted, const OutsideFlux& outside) {
  return emitted - (1 - outside.counted) * (bandSum(sumOf(outside)) - bandSum(outside.fromLamps));
}

/// Of the residual of the settings: at this share a solution ends if no light came to what is seen.
constexpr double smallestResidual = 1e-6;

/// The seen surfaces are dark while they have absorbed less than this share of the unshot flux. Their light then comes
/// through other rooms, so that patches count by their share of the unshot flux, not of all.
constexpr double darkShare = 1.0 / 16;

/// Shoots until a limit of the settings is reached, after the shots and splits of `past`. Adds what backs absorb of
/// each patch.
Solution shoot(const SolveInput& input, ShootingState& state, RowCache& rows, BandTable& absorbedByBacks,
               const Progress& progress, const Snapshot& past = {}) {
  const SolverSettings& settings = input.settings;
  const SeenLight& seen = input.seen;
  bool countsSeen = seen.scoutRow != nullptr;
  state.setSeen(seen.surfaces);
  Solution solution;
  solution.shots = past.shots;
  solution.residual = state.residual();
  bool isSeenDark = true;
  const auto lookAtSeen = [&] {
    if (!isSeenDark) return;
    isSeenDark = state.seenShare() < darkShare * solution.residual;
    if (!isSeenDark && !countsSeen) state.setSeen({});
  };
  lookAtSeen();
  const auto isDone = [&] {
    if (settings.shots && solution.shots >= *settings.shots) return true;
    if (solution.residual > settings.residual) return false;
    // Counting costs time: without scout rows it begins here.
    if (!std::exchange(countsSeen, true)) state.setSeen(seen.surfaces);
    const double residual = state.seenResidual();
    return residual <= seen.residual ||
           (std::isinf(residual) && solution.residual <= smallestResidual * settings.residual);
  };
  std::vector<SplitCall> splits = past.splits;
  const auto snapshot = [&] { return Snapshot{solution.shots, splits, absorbedByBacks, state.saved()}; };
  const double unitFlux = countedFlux(state.light().lastEmitted, state.light().outside) / unitsOfFlux;
  const auto weightOf = [&](std::uint32_t number) {
    const Patch& patch = state.patches().list[number];
    const double ofAll = sizeSum(state.unshot(number)) / (isSeenDark ? solution.residual : 1) / unitFlux;
    if (seen.surfaces.empty() || !seen.scoutRow || patch.isSettled) return ofAll;
    const double ofSeen = unitsOfFlux * state.seenGain(number, seen.scoutRow(patch));
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
      absorbedByBacks.resize(std::max(absorbedByBacks.size(), std::size_t{patch} + 1));
      addTo(absorbedByBacks[patch], state.unshot(patch), formFactor(row.back));
    }
    state.shoot(patch, row);
    ++solution.shots;
    solution.residual = state.residual();
    lookAtSeen();
    const bool isLast = isDone();
    if (input.prepare && !isLast) input.prepare({state.patches(), likelyShots});
    const bool goesOn = !progress || progress({solution.shots, solution.residual, isLast, snapshot});
    solution.isInterrupted = !goesOn && !isLast;
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
  const SavedShots& state = snapshot.state;
  const std::size_t bands = bandCount(input.scene);
  const auto isOf = [bands](const BandTable& table, std::size_t count) {
    return table.bands == bands && table.values.size() == count * bands;
  };
  const auto isSum = [bands](const KahanSum& sum) { return sum.sum.size() == bands && sum.rest.size() == bands; };
  const std::size_t count = patches.list.size();
  if (!isOf(state.shot, count) || !isOf(state.unshot, count) || !isOf(state.received, patches.ofElement.size()) ||
      !isOf(snapshot.absorbedByBacks, snapshot.absorbedByBacks.size()) || !isSum(state.lost) ||
      !isSum(state.lostToBacks))
    throw raster::InputError("the stored solution has another number of patches, elements or bands");
}

bool areFluxes(const BandTable& table) {
  return std::all_of(table.values.begin(), table.values.end(), [](double flux) { return flux >= 0; });
}

/// Throws InputError for a stored solution with values that no solution of the scene has: flux that came from nowhere,
/// or negative flux, which only an edit retracts.
void requireBalanced(const ShootingState& state, const Snapshot& snapshot, bool isEdited) {
  constexpr double tolerance = 1e-6;  // sums of a solution balance to 1e-12
  const Energy energy = state.energy();
  const double rounding = tolerance * bandSum(energy.emitted);
  double missing = 0;
  bool areLosses = true;
  for (std::size_t band = 0; band < energy.emitted.size(); ++band) {
    const double lost = energy.lost[band], toBacks = energy.lostToBacks[band];
    missing += std::abs(energy.emitted[band] - energy.absorbed[band] - energy.unshot[band] - lost);
    areLosses = areLosses && toBacks + rounding >= 0 && lost - toBacks + rounding >= 0;
  }
  const bool areSizes = snapshot.shots >= 0 && snapshot.absorbedByBacks.size() <= state.patches().list.size();
  const bool areAllFluxes = areFluxes(snapshot.state.shot) && areFluxes(snapshot.state.received) &&
                            areFluxes(snapshot.state.unshot) && areFluxes(snapshot.absorbedByBacks);
  if (!areSizes || !(missing <= rounding) || (!isEdited && !(areLosses && areAllFluxes)))
    throw raster::InputError("the stored solution does not balance: it is not one of this scene");
}

/// Completes a solution with its account of flux, its patches and its colours.
Solution finished(const SolveInput& input, Solution solution, ShootingState state, BandTable absorbedByBacks,
                  KeptRows rows) {
  const Scene& scene = input.scene;
  const BandColours colours(scene.wavelengths);
  solution.energy = state.energy();
  if (!absorbedByBacks.empty()) absorbedByBacks.resize(state.patches().list.size());
  solution.absorbedByBacks = colours.of(absorbedByBacks);
  solution.ambient = colours.of(ambientEstimate(input.discretization, state.materials(), solution.energy));
  solution.warnings = warningsOf(scene, solution.energy);
  if (input.isContinued) solution.continuation = Continuation{state.light(), std::move(rows)};
  solution.patches = state.takePatches();
  const bool keepsIrradiance = hasMaps(scene) || input.settings.keepsIrradiance;
  if (keepsIrradiance && scene.wavelengths.empty()) solution.irradiance = colours.of(state.irradiance());
  BandTable radiosity = std::move(state).radiosity();
  solution.radiosity = colours.of(radiosity);
  if (scene.wavelengths.empty()) return solution;
  if (keepsIrradiance) solution.irradiance = irradianceOf(input, solution.radiosity);
  solution.radiosityInBands = std::move(radiosity);
  return solution;
}

/// Solves from the light of `begun`, or from the snapshot of a solution that began with it.
Solution shootFrom(SolveInput input, Continuation begun, const Progress& progress, bool isEdited) {
  const Scene& scene = input.scene;
  const Discretization& discretization = input.discretization;
  Snapshot past{.absorbedByBacks = BandTable(0, bandCount(scene))};
  if (input.snapshot) {
    past = *input.snapshot;
    splitAgain(input, past);
  }
  ShootingState state =
      input.snapshot
          ? ShootingState(scene, discretization, std::move(input.patches), std::move(begun.light), past.state)
          : ShootingState(scene, discretization, std::move(input.patches), std::move(begun.light));
  if (input.snapshot) requireBalanced(state, past, isEdited);
  BandTable absorbedByBacks = past.absorbedByBacks;
  Solution solution = shoot(input, state, begun.rows.ofPatches, absorbedByBacks, progress, past);
  return finished(input, std::move(solution), std::move(state), std::move(absorbedByBacks), std::move(begun.rows));
}

}  // namespace

double defaultResidual(const Scene& scene, const Discretization& discretization, const OutsideFlux& outside) {
  const double emitted = bandSum(emittedFlux(scene, discretization)) + bandSum(sumOf(outside));
  return SolverSettings().residual * (emitted > 0 ? countedFlux(emitted, outside) / emitted : 1);
}

std::string endOf(const Solution& solution, const SolverSettings& settings) {
  if (solution.isInterrupted) return "progress";
  return settings.shots && solution.shots >= *settings.shots ? "shots" : "residual";
}

Solution solve(SolveInput input, const Progress& progress) {
  assert(!input.patches.list.empty());
  ShotLight nothing = input.snapshot ? ShotLight{.outside = std::move(input.outside)}
                                     : nothingShot(input.patches, bandCount(input.scene), std::move(input.outside));
  const std::size_t bytes = input.settings.rowCacheBytes;
  KeptRows rows{RowCache(input.isContinued ? bytes / 2 : bytes), RowCache(bytes / 2)};
  return shootFrom(std::move(input), {std::move(nothing), std::move(rows)}, progress, false);
}

Solution refine(SolveInput input, Continuation past, const Progress& progress) {
  return shootFrom(std::move(input), std::move(past), progress, true);
}

}  // namespace hemitex::radiosity
