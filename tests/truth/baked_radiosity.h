/// Radiosity of each element by light tracing: only rays, no form factors, item buffers or equations. So it is
/// independent of all other methods of this project.
///
/// Paths start at the emitting elements, in proportion to flux, uniformly over each element and cosine-distributed.
/// Those of a uniform sky (`scene.outside`; suns are ignored) start on a sphere around the scene, those of lamps that
/// are points at these. A surface whose front a path meets receives the flux of the path. A share of it, the
/// reflectance per band, continues in another cosine-distributed direction. Paths end by Russian roulette. Backs of
/// faces and the background absorb; backs with a twin let rays pass (see ray_caster.h). The error of an element's flux
/// is proportional to the root of that flux. So the sum of all errors is a smaller share of the light than with the
/// same number of rays gathered from each element.
///
/// Points distributed uniformly over an element measure its exposed area. A point is *buried* if a face of opposite
/// direction lies on it. A second test uses 32 random walks, which all fronts reflect for up to 64 bounces. The point
/// is buried if no walk sees a light, and some meet a back or leave the scene. Such points lie inside a solid or
/// outside a room. They also lie in the space that a solid without bottom or back encloses with the floor and the
/// walls. In a narrow gap walks meet nothing else and stay, so that its faces are exposed. Faces of emitters that see
/// only background are exposed too.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::tests {

struct BakeSettings {
  int paths = 1 << 20;  ///< total; 32 times a power of two, below 2^30 (see sample_points.h)
  int points = 256;     ///< per element, for its exposed area; 32 times a power of two
  std::uint32_t seed = 0;
};

/// Sums over the elements of one surface.
struct SurfaceFlux {
  double exposedArea = 0, exposedAreaError = 0;
  glm::dvec3 flux{0.0}, fluxError{0.0};
};

/// One value per element, and one per surface. Errors are standard errors, one standard deviation.
struct BakedRadiosity {
  std::vector<double> exposedArea;         ///< area times the share of points that are not buried
  std::vector<double> exposedAreaError;    ///< of `exposedArea`
  std::vector<glm::dvec3> flux;            ///< outgoing flux, W per band
  std::vector<glm::dvec3> fluxError;       ///< of `flux`
  std::vector<glm::dvec3> radiosity;       ///< flux over exposed area, W/m^2; 0 without exposed area
  std::vector<glm::dvec3> radiosityError;  ///< of `radiosity`
  std::vector<SurfaceFlux> surfaces;
};

/// Throws InputError for an invalid number of paths or points. Gives the same bits for any number of threads.
BakedRadiosity bakedRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const BakeSettings& settings = {});

}  // namespace hemitex::tests
