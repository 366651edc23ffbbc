#include "radiosity/solver/error_control.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "radiosity/scene/scene.h"
#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

constexpr std::array<Effort, 10> ladder{{{0.05, 64},
                                         {0.025, 96},
                                         {0.0125, 128},
                                         {0.006, 192},
                                         {0.003, 256},
                                         {0.0015, 384},
                                         {0.00075, 512},
                                         {0.0004, 768},
                                         {0.0002, 1024},
                                         {0.0001, 1536}}};

/// Share of the bound that is reserved for errors common to two solutions, which their difference does not show.
constexpr double commonShare = 0.25;

/// The flux by which elements differ, and their flux.
struct Difference {
  double different = 0, flux = 0;

  void add(const Difference& other) {
    different += other.different;
    flux += other.flux;
  }
  double share() const { return different > 0 ? different / flux : 0; }
};

/// An upper bound of the errors of the finer one of two solutions with these differences.
LightErrors expectedErrors(const LightErrors& difference) {
  const double factor = 1 / std::sqrt(2.0) / (1 - commonShare);
  return {difference.all * factor, difference.seen * factor};
}

/// The first step of the ladder that is as fine as `coarsest`.
std::size_t firstStep(const Effort& coarsest) {
  const auto isFine = [&](const Effort& effort) {
    return effort.resolution >= coarsest.resolution && effort.split <= coarsest.split;
  };
  return static_cast<std::size_t>(std::find_if(ladder.begin(), ladder.end(), isFine) - ladder.begin());
}

}  // namespace

void requireEfforts(const Effort& coarsest) {
  if (firstStep(coarsest) + 2 <= ladder.size()) return;
  const Effort& last = ladder[ladder.size() - 2];
  throw raster::InputError("no finer effort is left to estimate the error with",
                           "with a bound on the error, use a resolution of at most " + std::to_string(last.resolution) +
                               " and a split of at least " + raster::shortNumber(last.split));
}

LightErrors lightErrors(const Discretization& discretization, const std::vector<bool>& seen,
                        std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth) {
  assert(found.size() == discretization.elements.size() && truth.size() == found.size());
  assert(seen.empty() || seen.size() == discretization.grids.size());
  Difference ofAll, ofSeen;
  for (std::size_t e = 0; e < found.size(); ++e) {
    const Element& element = discretization.elements[e];
    const Difference difference{element.area * bandSum(glm::abs(found[e] - truth[e])),
                                element.area * bandSum(truth[e])};
    ofAll.add(difference);
    if (!seen.empty() && seen[element.surface]) ofSeen.add(difference);
  }
  return {ofAll.share(), ofSeen.share()};
}

double residualFor(double bound) { return bound / 10; }

ErrorBoundChoice chooseEffort(const Discretization& discretization, const std::vector<bool>& seen,
                              const SolveWith& solveWith, double bound, const EffortLimits& limits) {
  requireEfforts(limits.coarsest);
  std::vector<glm::dvec3> coarser;
  std::optional<LightErrors> expected;
  for (std::size_t step = firstStep(limits.coarsest); step < ladder.size(); ++step) {
    std::vector<glm::dvec3> finer = solveWith(ladder[step]);
    if (!coarser.empty()) expected = expectedErrors(lightErrors(discretization, seen, coarser, finer));
    const bool isKept = expected && expected->larger() <= bound;
    if (isKept || (limits.isLast && limits.isLast())) return {ladder[step], expected};
    coarser = std::move(finer);
  }
  throw raster::InputError(
      "so small an error is out of reach for this scene",
      "ask for " + raster::toText(std::ceil(expected->larger() * 1e4) / 1e4) + ", or for fewer texels");
}

}  // namespace hemitex::radiosity
