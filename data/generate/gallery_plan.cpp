#include "data/generate/gallery_plan.h"

#include <algorithm>

namespace hemitex::data {

double bayMiddle(int bay) { return (bay + 0.5) * bayLength - halfLength; }
double bayStart(int bay) { return bay * bayLength - halfLength; }
double sideSign(const std::string& side) { return side == "library" ? -1 : 1; }

Wall wallAtX(double x, bool facesRight) { return {{x, 0, 0}, facesRight ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 0, 1)}; }
Wall wallAtZ(double z, bool facesViewer) {
  return {{0, 0, z}, facesViewer ? glm::dvec3(1, 0, 0) : glm::dvec3(-1, 0, 0)};
}

Rectangle span(const Wall& wall, double from, double to, double bottom, double top) {
  const double a = glm::dot(wall.along, glm::dvec3(from)), b = glm::dot(wall.along, glm::dvec3(to));
  return {std::min(a, b), std::max(a, b), bottom, top};
}

void append(std::vector<Group>& groups, const std::vector<Group>& more) {
  groups.insert(groups.end(), more.begin(), more.end());
}

}  // namespace hemitex::data
