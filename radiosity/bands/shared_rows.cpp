#include "radiosity/bands/shared_rows.h"

#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>

#include "radiosity/base/kahan_sum.h"
#include "radiosity/form_factors/row_cache.h"
#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {
namespace {

/// The light of the solutions so far, from which that of the next one is guessed.
struct EarlierLight {
  std::vector<bool> hasShot = {};     ///< one per patch: whether it shot in any of them
  std::vector<double> received = {};  ///< one per element, of the last one with light, bands summed
  double emitted = 0;                 ///< of the last one with light, bands summed
};

/// The flux that the elements of a patch send out if they receive what they did before, times a factor per band.
glm::dvec3 expectedShot(const SolveInput& input, const Patch& patch, const EarlierLight& before,
                        const glm::dvec3& factors) {
  const SurfaceValues emission = emissions(input.scene, input.discretization, patch.surface),
                      reflectance = reflectances(input.scene, input.discretization, patch.surface);
  glm::dvec3 sum(0);
  for (const std::uint32_t element : patch.elements)
    sum += emission.of(element) * input.discretization.elements[element].area +
           reflectance.of(element) * factors * before.received[element];
  return sum;
}

/// The light after each patch that shot before has shot what it is expected to. Elements are expected to receive the
/// same share of the emitted flux as before.
ShotLight expectedLight(SolveInput& input, const EarlierLight& before, RowCache& rows) {
  const glm::dvec3 emitted = emittedFlux(input.scene, input.discretization) + sumOf(input.outside);
  const glm::dvec3 factors = before.emitted > 0 ? emitted / before.emitted : glm::dvec3(0);
  ShotLight light = nothingShot(input.patches, std::move(input.outside));
  KahanSum lost, lostToBacks;
  for (std::uint32_t p = 0; p < input.patches.list.size(); ++p) {
    if (p >= before.hasShot.size() || !before.hasShot[p]) continue;
    const glm::dvec3 shot = expectedShot(input, input.patches.list[p], before, factors);
    const FormFactorRow& row = rows.row(p, [&] { return input.rowOf(input.patches.list[p]); });
    light.shot[p] = shot;
    for (std::size_t i = 0; i < row.elements.size(); ++i)
      light.received[row.elements[i]] += shot * formFactor(row.shares[i]);
    lost.add(shot * formFactor(row.background + row.back));
    lostToBacks.add(shot * formFactor(row.back));
  }
  light.lost = lost.value();
  light.lostToBacks = lostToBacks.value();
  return light;
}

/// Adds the light of a solution.
void add(const Solution& solution, EarlierLight& light) {
  if (bandSum(solution.energy.emitted) == 0) return;
  const ShotLight& last = solution.continuation->light;
  light.hasShot.resize(last.shot.size());
  for (std::size_t p = 0; p < last.shot.size(); ++p)
    if (last.shot[p] != glm::dvec3(0)) light.hasShot[p] = true;
  light.received.clear();
  for (const glm::dvec3& flux : last.received) light.received.push_back(bandSum(flux));
  light.emitted = bandSum(solution.energy.emitted);
}

}  // namespace

std::vector<Solution> solveWithSameRows(std::size_t count, Patches patches, const InputOf& inputOf,
                                        const Progress& progress) {
  assert(count > 0);
  std::vector<Solution> solutions;
  std::optional<RowCache> rows;
  EarlierLight before;
  bool goesOn = true;
  for (std::size_t i = 0; i < count; ++i) {
    SolveInput input = inputOf(i);
    if (!rows) rows.emplace(input.settings.rowCacheBytes);
    input.rows = &*rows;  // by the numbers of patches; one that has a row is not split any more
    input.patches = std::move(patches);
    input.isContinued = true;
    const Progress shown = [&](const Step& step) {
      goesOn = goesOn && (!progress || progress(step));
      return goesOn;
    };
    if (i == 0) {
      solutions.push_back(solve(std::move(input), shown));
    } else {
      ShotLight light = expectedLight(input, before, *rows);
      solutions.push_back(refine(std::move(input), {std::move(light), {RowCache(0), RowCache(0)}}, shown));
    }
    Solution& solution = solutions.back();
    add(solution, before);
    solution.continuation.reset();
    patches = std::move(solution.patches);
  }
  solutions.back().patches = std::move(patches);
  return solutions;
}

}  // namespace hemitex::radiosity
