#include "data/generate/shapes.h"

#include <algorithm>
#include <array>

namespace hemitex::data {

Polygon rectangle(double x0, double x1, double z0, double z1, double y) {
  return {{{x0, y, z1}, {x1, y, z1}, {x1, y, z0}, {x0, y, z0}}};
}

Polygon reversed(const Polygon& polygon) {
  Polygon result = polygon;
  std::reverse(result.corners.begin(), result.corners.end());
  std::reverse(result.texcoords.begin(), result.texcoords.end());
  return result;
}

Polygon atHeight(const Polygon& polygon, double y) {
  Polygon result = polygon;
  for (glm::dvec3& corner : result.corners) corner.y = y;
  return result;
}

std::vector<Polygon> sides(const Polygon& top, double y) {
  const Polygon bottom = atHeight(top, y);
  std::vector<Polygon> result;
  for (std::size_t i = 0; i < top.corners.size(); ++i) {
    const std::size_t next = (i + 1) % top.corners.size();
    result.push_back({{bottom.corners[i], bottom.corners[next], top.corners[next], top.corners[i]}});
  }
  return result;
}

std::vector<Group> walls(const Polygon& ceiling, const std::vector<std::string>& materials) {
  const std::array<std::string, 4> names{"wall-front", "wall-right", "wall-back", "wall-left"};
  const std::vector<Polygon> outside = sides(ceiling, 0);
  std::vector<Group> result;
  for (std::size_t i = 0; i < names.size(); ++i) result.push_back({names[i], materials[i], {reversed(outside[i])}});
  return result;
}

}  // namespace hemitex::data
