/// Progressive refinement (Cohen, Chen, Wallace and Greenberg 1988): shoot the patch with the most unshot flux, until
/// little is left. All flux is accounted for: emitted = absorbed + unshot + lost.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/form_factors.h"
#include "radiosity/scene.h"

namespace hemitex::radiosity {

struct SolverSettings {
  double residual = 0.001;        ///< stop when unshot over emitted flux, bands summed, is at most this; >= 0
  std::optional<int> shots = {};  ///< stop after so many shots at the latest; >= 0
  std::size_t rowCacheBytes = std::size_t{1024} << 20;  ///< rows kept for the next shot of the same patch
};

/// Flux per RGB band.
struct Energy {
  glm::dvec3 emitted{0.0};
  glm::dvec3 absorbed{0.0};
  glm::dvec3 unshot{0.0};
  glm::dvec3 lost{0.0};         ///< left the scene or was absorbed by backs
  glm::dvec3 lostToBacks{0.0};  ///< the part of `lost` that backs absorbed
};

struct Solution {
  std::vector<glm::dvec3> radiosity;  ///< one an element, W/m^2 per band, without the ambient estimate
  glm::dvec3 ambient{0.0};  ///< ambient radiosity of the unshot flux; times reflectance it is added for display only
  Energy energy;
  double residual = 0;  ///< unshot over emitted flux, bands summed
  int shots = 0;
  std::vector<std::string> warnings;
};

/// Where a patch's row comes from: the hemicube, or any other method.
using RowSource = std::function<FormFactorRow(std::uint32_t patch)>;
/// Called after each shot with the number of shots and the residual.
using Progress = std::function<void(int shots, double residual)>;

/// Starts from the emission of every element and shoots until the settings say stop. The same for any number of
/// threads and any budget of the row cache.
Solution solve(const Scene& scene, const Discretization& discretization, const RowSource& rowOf,
               const SolverSettings& settings, const Progress& progress = {});

}  // namespace hemitex::radiosity
