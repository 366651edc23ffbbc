#include "radiosity/projection/sphere_directions.h"

#include <cmath>
#include <cstddef>

namespace hemitex::radiosity {

std::vector<glm::dvec3> sphereDirections(int count) {
  // Each point is rotated against the one before by the golden angle, pi (3 - sqrt(5)). A product with constants
  // replaces sines, whose last digits differ between machines.
  constexpr double cosine = -0.7373688780783197, sine = 0.6754902942615238;
  std::vector<glm::dvec3> directions(static_cast<std::size_t>(count));
  glm::dvec2 around(1, 0);
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count;
    const glm::dvec2 xy = around * std::sqrt(1 - z * z);
    directions[static_cast<std::size_t>(i)] = {xy, z};
    around = {around.x * cosine - around.y * sine, around.x * sine + around.y * cosine};
  }
  return directions;
}

}  // namespace hemitex::radiosity
