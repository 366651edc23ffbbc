/// Settings for a bound on the error: as much work as the scene asks for, and no more.
///
/// The error of a solution is its flux-weighted error (RadiosityError) against the true radiosity of the elements of
/// the finest index maps that are asked for. Three things cause it, and each has its setting: patches that shoot as one
/// (their number along a surface), points that are too near (how far patches are split), and directions between pixels
/// (the resolution of hemicubes). They are refined together, along a ladder of settings whose steps cost about 1.3
/// times as much each; on a step down the ladder the three errors keep about the same proportion.
///
/// How large errors are in a scene, two coarse solutions say, the first two steps: their difference D is little less
/// than the error of the first. What the others leave of it was measured once, by solutions of the scenes of data/ with
/// 8 and 16 texels against their true radiosity: the largest of these ratios of error to D stands in the ladder. So the
/// expected error is an estimate, and a careful one; it is no proof for every scene.
///
/// Index maps are coarsened last, where that hides little: what constant elements hide is what the second solution's
/// elements differ from their means.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/scene.h"

namespace hemitex::reference {

/// How hard a solution tries. Hemicubes are turned.
struct Effort {
  int patches = 4;        ///< along a side of the finest index map
  double split = 0.0125;  ///< see radiosity::splitPatches
  int resolution = 128;   ///< of hemicubes
};

struct ErrorBoundChoice {
  Effort effort;
  std::map<std::string, int> surfaceTexels;  ///< the index maps that are coarser, by surface name
  double expectedError = 0;
};

/// The radiosity of every element at an effort, all index maps at their finest.
using SolveWith = std::function<std::vector<glm::dvec3>(const Effort&)>;

/// The share of all emitted flux that may stay unshot for a bound on the error: a tenth of the bound.
double residualFor(double bound);

/// The least effort whose expected error is within `bound`, above 0. Elements and patches of `finest` are those of
/// index maps of `texels` columns and rows; surfaces of other grids keep theirs. Throws InputError where no effort of
/// the ladder is enough; the advice says which bound is in reach.
ErrorBoundChoice chooseEffort(const radiosity::Scene& scene, const radiosity::Discretization& finest, int texels,
                              const SolveWith& solveWith, double bound);

/// Coarser index maps, halved once or more but to no fewer texels than `fewest`, that together hide no more than
/// `budget` of all flux: the flux by which elements differ from the mean of the coarse texel that they lie in, bands
/// summed. Those that hide least come first; of equals, surfaces in their order.
std::map<std::string, int> coarserMaps(const radiosity::Scene& scene, const radiosity::Discretization& finest,
                                       int texels, int fewest, std::span<const glm::dvec3> radiosity, double budget);

}  // namespace hemitex::reference
