/// Measures time, error and memory of solutions for methods at all settings and on several grids. Errors are those of
/// rows and of radiosity, relative to the truth.
///
/// A time is that of a solution, from the discretized scene to the radiosity of each element. Times are measured in
/// rounds, which are interleaved repetitions (timing.h). All results except times are the same for any number of
/// threads.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/measurement/bench/timing.h"
#include "reference/measurement/tradeoff/methods.h"
#include "reference/truth/solution/ground_truth.h"
#include "reference/truth/solution/radiosity_error.h"
#include "reference/truth/solution/row_error.h"

namespace hemitex::reference {

/// Number of rounds. A choice that takes more than `longTime` seconds is measured once.
inline constexpr int tradeRounds = 3;
inline constexpr double longTime = 1;
/// Solutions end when this share of the emitted flux is unshot. It is smaller than the measured errors.
inline constexpr double tradeResidual = 1e-4;

struct TradeChoice {
  std::size_t method = 0;  ///< index in the list of methods
  int setting = 0;
  int texels = 16, patch = 4;
};

/// All settings of each method on the first grid, which has the first number of texels and the first patch size. On all
/// other grids, only the settings up to the middle of the list. Patches larger than a surface are omitted.
std::vector<TradeChoice> tradeChoices(const std::vector<TradeMethod>& methods, const std::vector<int>& texels,
                                      const std::vector<int>& patches);

struct TradeMeasurement {
  TradeChoice choice;
  std::size_t elements = 0, patches = 0;  ///< patches: after splitting
  std::size_t rows = 0;                   ///< number of patches that shot
  int shots = 0;
  RowError rowError;  ///< of the rows of all patches with true flux above 0
  RadiosityError error;
  std::size_t bufferBytes = 0;        ///< see TradeMethod
  std::size_t rowBytes = 0;           ///< of all kept rows
  std::size_t elementBytes = 0;       ///< of the discretization, and of the flux and unshot flux of each element
  std::vector<glm::dvec3> radiosity;  ///< one per element of its own grids
  Timing seconds;                     ///< one repetition per round
  bool isOnFront = false;             ///< see markFront
};

/// Sets whether each choice is on the Pareto front. It is not if another one has at most the same median time and
/// error, and less time or a smaller error.
void markFront(std::vector<TradeMeasurement>& measurements);

/// Measures all choices; `makeRenderer` makes what draws rows. `fine` has the elements of the truth; its number of
/// texels must be a multiple of those of the choices. `progress` is called before each solution with the number of
/// finished solutions and of all.
std::vector<TradeMeasurement> measureTradeoff(
    const radiosity::Scene& scene, const radiosity::Discretization& fine, const TrueRadiosity& truth,
    const std::vector<TradeMethod>& methods, const std::vector<TradeChoice>& choices,
    const std::function<void(std::size_t, std::size_t)>& progress = {},
    const radiosity::RendererFactory& makeRenderer = radiosity::softwareRenderer);

/// The expected statistical error of the true rows of patches of a discretization.
RowError trueRowError(const radiosity::Discretization& fine, const TrueRadiosity& truth,
                      const radiosity::Discretization& discretization);

}  // namespace hemitex::reference
