#include "reference/error_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <tuple>

#include "raster/input_error.h"
#include "reference/radiosity_error.h"

namespace hemitex::reference {
namespace {

struct Step {
  Effort effort;
  double errorOverDifference;  ///< the error, over the difference of the solutions of the first two steps; at most
};

constexpr std::array<Step, 11> ladder{{{{2, 0.1, 64}, 1.55},
                                       {{2, 0.05, 128}, 0.95},
                                       {{4, 0.05, 96}, 0.53},
                                       {{4, 0.04, 112}, 0.5},
                                       {{4, 0.03, 128}, 0.33},
                                       {{4, 0.0175, 128}, 0.24},
                                       {{4, 0.0125, 128}, 0.225},
                                       {{4, 0.0125, 160}, 0.2},
                                       {{4, 0.0125, 256}, 0.185},
                                       {{4, 0.006, 384}, 0.14},
                                       {{8, 0.006, 384}, 0.135}}};

/// Of the bound: what index maps may hide, so that little is taken from the rest.
constexpr double hiddenShare = 0.05;

double bandSum(const glm::dvec3& value) { return value.x + value.y + value.z; }

struct CoarseTexel {
  glm::dvec3 flux{0.0};
  double area = 0;
};

/// The flux that texels `factor` times as large hide on a surface.
double hiddenFlux(const radiosity::Discretization& finest, const radiosity::Grid& grid,
                  std::span<const glm::dvec3> radiosity, int factor) {
  const auto columns = static_cast<std::uint32_t>(grid.columns), times = static_cast<std::uint32_t>(factor);
  std::vector<CoarseTexel> coarse(grid.spill.size());
  const auto texelOf = [&](const radiosity::Element& element) -> CoarseTexel& {
    return coarse[element.texel / columns / times * columns + element.texel % columns / times];
  };
  const auto elements = std::span(finest.elements).subspan(grid.firstElement, grid.elementCount);
  const auto values = radiosity.subspan(grid.firstElement, grid.elementCount);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    CoarseTexel& texel = texelOf(elements[e]);
    texel.flux += elements[e].area * values[e];
    texel.area += elements[e].area;
  }
  double hidden = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const CoarseTexel& texel = texelOf(elements[e]);
    hidden += elements[e].area * bandSum(glm::abs(values[e] - texel.flux / texel.area));
  }
  return hidden;
}

/// A halving of a surface's map: what it hides beyond the halvings before it.
struct Halving {
  double hidden;
  std::uint32_t surface;
  int texels;
};

std::vector<Halving> halvings(const radiosity::Discretization& finest, int texels, int fewest,
                              std::span<const glm::dvec3> radiosity) {
  std::vector<Halving> all;
  for (std::uint32_t surface = 0; surface < finest.grids.size(); ++surface) {
    const radiosity::Grid& grid = finest.grids[surface];
    if (grid.columns != texels || grid.rows != texels) continue;
    double before = 0;
    for (int factor = 2; texels % factor == 0 && texels / factor >= fewest; factor *= 2) {
      const double hidden = hiddenFlux(finest, grid, radiosity, factor);
      // Never less than the halving before, so that in ascending order each comes after it.
      const double more = std::max(hidden - before, factor > 2 ? all.back().hidden : 0.0);
      all.push_back({more, surface, texels / factor});
      before = hidden;
    }
  }
  return all;
}

}  // namespace

double residualFor(double bound) { return bound / 10; }

std::map<std::string, int> coarserMaps(const radiosity::Scene& scene, const radiosity::Discretization& finest,
                                       int texels, int fewest, std::span<const glm::dvec3> radiosity, double budget) {
  double left = 0;
  for (std::size_t e = 0; e < finest.elements.size(); ++e) left += finest.elements[e].area * bandSum(radiosity[e]);
  left *= budget;
  std::vector<Halving> all = halvings(finest, texels, fewest, radiosity);
  std::sort(all.begin(), all.end(), [](const Halving& a, const Halving& b) {
    return std::tuple(a.hidden, a.surface, -a.texels) < std::tuple(b.hidden, b.surface, -b.texels);
  });
  std::map<std::string, int> coarser;
  for (const Halving& halving : all) {
    left -= halving.hidden;
    if (left < 0) break;
    coarser[scene.surfaces[halving.surface].name] = halving.texels;
  }
  return coarser;
}

ErrorBoundChoice chooseEffort(const radiosity::Scene& scene, const radiosity::Discretization& finest, int texels,
                              const SolveWith& solveWith, double bound) {
  const std::vector<glm::dvec3> first = solveWith(ladder[0].effort), second = solveWith(ladder[1].effort);
  const double difference = errorOf(finest, first, second).fluxWeighted;
  const auto enough = std::find_if(ladder.begin(), ladder.end(), [&](const Step& step) {
    return step.errorOverDifference * difference <= bound * (1 - hiddenShare);
  });
  if (enough == ladder.end()) {
    const double inReach = ladder.back().errorOverDifference * difference / (1 - hiddenShare);
    std::ostringstream advice;
    advice << "ask for " << std::ceil(inReach * 1e4) / 1e4 << ", or for fewer texels";
    throw raster::InputError("so small an error is out of reach for this scene", advice.str());
  }
  return {enough->effort, coarserMaps(scene, finest, texels, enough->effort.patches, second, hiddenShare * bound),
          enough->errorOverDifference * difference + hiddenShare * bound};
}

}  // namespace hemitex::reference
