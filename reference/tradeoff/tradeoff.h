/// What accuracy costs: methods at all their settings, on several grids, side by side in one run: how long each takes,
/// how far its rows and its light are from the truth, how much memory it holds.
///
/// All times are of a whole solution, from the discretized scene to the radiosity of every element, in interleaved
/// repetitions (timing.h): rounds. Everything but times is the same for any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/bench/timing.h"
#include "reference/solution/ground_truth.h"
#include "reference/solution/radiosity_error.h"
#include "reference/solution/row_error.h"
#include "reference/tradeoff/methods.h"

namespace hemitex::reference {

/// Of each choice; but once it takes longer than `longTime` seconds, it is not repeated.
inline constexpr int tradeRounds = 3;
inline constexpr double longTime = 1;
/// Solutions go on until so much of the emitted light is left unshot: less than the errors that are measured.
inline constexpr double tradeResidual = 1e-4;

struct TradeChoice {
  std::size_t method = 0;  ///< in the list of methods
  int setting = 0;
  int texels = 16, patch = 4;
};

/// Every method at every of its settings on grids of the first number of texels and the first size of a patch; at the
/// settings up to the middle of its list on all others as well. Patches larger than a surface are left out.
std::vector<TradeChoice> tradeChoices(const std::vector<TradeMethod>& methods, const std::vector<int>& texels,
                                      const std::vector<int>& patches);

struct TradeMeasurement {
  TradeChoice choice;
  std::size_t elements = 0, patches = 0;  ///< patches as the method split them
  std::size_t rows = 0;                   ///< patches that shot
  int shots = 0;
  RowError rowError;  ///< of the rows of all patches that light leaves, as the truth has it
  RadiosityError error;
  std::size_t bufferBytes = 0;        ///< see TradeMethod
  std::size_t rowBytes = 0;           ///< of the rows that were kept
  std::size_t elementBytes = 0;       ///< of the discretization, and of the flux and unshot flux of every element
  std::vector<glm::dvec3> radiosity;  ///< one an element of its own grids
  Timing seconds;                     ///< one repetition per round
  bool isOnFront = false;             ///< no other choice has a smaller median time and a smaller error
};

/// `fine` has the elements of the truth; the texels of choices divide its own. `progress` is called before every
/// solution with the number of those that are done, out of all.
std::vector<TradeMeasurement> measureTradeoff(const radiosity::Scene& scene, const radiosity::Discretization& fine,
                                              const TrueRadiosity& truth, const std::vector<TradeMethod>& methods,
                                              const std::vector<TradeChoice>& choices,
                                              const std::function<void(std::size_t, std::size_t)>& progress = {});

/// The expected error of the true rows of patches of a discretization, by chance.
RowError trueRowError(const radiosity::Discretization& fine, const TrueRadiosity& truth,
                      const radiosity::Discretization& discretization);

}  // namespace hemitex::reference
