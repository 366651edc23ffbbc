/// Light from outside a scene: a uniform sky on all sides, and suns.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace hemitex::radiosity {

/// Parallel light.
struct Sun {
  glm::dvec3 towards{0.0};     ///< unit vector from the scene to the sun
  glm::dvec3 irradiance{0.0};  ///< of a plane at right angles to the light, W/m^2 per band, >= 0
};

struct OutsideLight {
  /// The irradiance of a plane that nothing hides, W/m^2 per band, >= 0. The sky surrounds the scene, also from below,
  /// because no axis of a file is known to point up. Its radiance is this value over pi.
  glm::dvec3 sky{0.0};
  std::vector<Sun> suns = {};
};

/// The largest irradiance of the sky and the suns in any band.
inline double brightest(const OutsideLight& light) {
  const auto largest = [](const glm::dvec3& bands) { return glm::max(glm::max(bands.r, bands.g), bands.b); };
  double result = largest(light.sky);
  for (const Sun& sun : light.suns) result = glm::max(result, largest(sun.irradiance));
  return result;
}

}  // namespace hemitex::radiosity
