/// Radiosity of every element by light tracing: rays only, no form factors, no item buffers, no equations. An
/// independent truth for all that this project computes in other ways.
///
/// Paths leave the emitting elements, in proportion to flux, evenly over each and cosine-distributed. Whatever a path
/// meets from the front receives the flux that it carries; a share of it, the reflectance per band, goes on in another
/// cosine-distributed direction. Paths end by Russian roulette. Backs of faces and the background absorb; backs with a
/// twin let rays pass (see ray_caster.h). The error of an element's flux falls with the root of that flux: the sum of
/// all errors is a smaller share of the light than with as many rays that are gathered from every element.
///
/// An element's exposed area is found by points spread evenly over it. A point is *buried* where a face that looks the
/// other way lies on it. It also is where none of 32 random walks, reflected by all fronts for up to 64 bounces, comes
/// to see a light, and some meet a back or leave the scene: inside a solid, in the space that a solid without bottom or
/// back encloses with the floor and the walls, and outside of a room. In a narrow gap walks meet nothing and stay: its
/// faces are exposed. So are those of emitters that see nothing but background.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::reference {

struct BakeSettings {
  int paths = 1 << 20;  ///< in all; 32 times a power of two, below 2^30 (see sample_points.h)
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
  std::vector<glm::dvec3> flux;            ///< that leaves, W per band
  std::vector<glm::dvec3> fluxError;       ///< of `flux`
  std::vector<glm::dvec3> radiosity;       ///< flux over exposed area, W/m^2; 0 without exposed area
  std::vector<glm::dvec3> radiosityError;  ///< of `radiosity`
  std::vector<SurfaceFlux> surfaces;
};

/// Throws InputError where a number of paths or points is not as said above.
/// The same bits for any number of threads.
BakedRadiosity bakedRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const BakeSettings& settings = {});

}  // namespace hemitex::reference
