/// Progressive refinement (Cohen, Chen, Wallace and Greenberg 1988): shoot the patch with the most unshot flux, until
/// little is left. All flux is accounted for: emitted = absorbed + unshot + lost (see shooting_state.h).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/row_cache.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/shooting_state.h"

namespace hemitex::radiosity {

struct SolverSettings {
  double residual = 0.001;        ///< stop when unshot over emitted flux, bands summed, is at most this; >= 0
  std::optional<int> shots = {};  ///< stop after so many shots at the latest; >= 0
  std::size_t rowCacheBytes = std::size_t{1024} << 20;  ///< rows kept for the next shot of the same patch
};

struct Solution {
  std::vector<glm::dvec3> radiosity;  ///< one an element, W/m^2 per band, without the ambient estimate
  glm::dvec3 ambient{0.0};  ///< ambient radiosity of the unshot flux; times reflectance it is added for display only
  Energy energy;
  double residual = 0;  ///< unshot over emitted flux, bands summed (see ShootingState::residual)
  int shots = 0;
  std::vector<std::string> warnings;
};

/// Splits a patch that is about to shoot for the first time, where one point is too few for it. `weight` is its unshot
/// flux over a 256th of all emitted flux: the brighter a patch, the more a split is worth. Returns the numbers of the
/// new patches, which are the last of the discretization; elements of the patch have moved to them.
using PatchSplit = std::function<std::vector<std::uint32_t>(std::uint32_t patch, double weight)>;

/// Called after each shot with the number of shots and the residual.
using Progress = std::function<void(int shots, double residual)>;

/// Starts from the emission of every element and shoots until the settings say stop. `split` splits patches of
/// `discretization`; without it they stay as they are. The same for any number of threads and any budget of the row
/// cache.
Solution solve(const Scene& scene, const Discretization& discretization, const RowSource& rowOf,
               const SolverSettings& settings, const Progress& progress = {}, const PatchSplit& split = {});

/// Continues a refinement of the scene until the settings say stop; counts shots from here.
Solution refine(const Scene& scene, const Discretization& discretization, ShootingState& state, RowCache& rows,
                const RowSource& rowOf, const SolverSettings& settings, const Progress& progress = {},
                const PatchSplit& split = {});

}  // namespace hemitex::radiosity
