#include "radiosity/solver/error_control.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

#include "radiosity/scene/scene.h"
#include "raster/base/input_error.h"

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

/// The flux by which the elements of two solutions differ, over that of the second.
double difference(const Discretization& discretization, const std::vector<glm::dvec3>& first,
                  const std::vector<glm::dvec3>& second) {
  assert(first.size() == discretization.elements.size() && second.size() == first.size());
  double different = 0, flux = 0;
  for (std::size_t e = 0; e < first.size(); ++e) {
    different += discretization.elements[e].area * bandSum(glm::abs(first[e] - second[e]));
    flux += discretization.elements[e].area * bandSum(second[e]);
  }
  return different > 0 ? different / flux : 0;
}

}  // namespace

double residualFor(double bound) { return bound / 10; }

ErrorBoundChoice chooseEffort(const Discretization& discretization, const SolveWith& solveWith, double bound) {
  std::vector<glm::dvec3> coarser = solveWith(ladder.front());
  double expected = 0;
  for (std::size_t step = 1; step < ladder.size(); ++step) {
    std::vector<glm::dvec3> finer = solveWith(ladder[step]);
    expected = difference(discretization, coarser, finer) / std::sqrt(2.0) / (1 - commonShare);
    if (expected <= bound) return {ladder[step], expected};
    coarser = std::move(finer);
  }
  std::ostringstream advice;
  advice << "ask for " << std::ceil(expected * 1e4) / 1e4 << ", or for fewer texels";
  throw raster::InputError("so small an error is out of reach for this scene", advice.str());
}

}  // namespace hemitex::radiosity
