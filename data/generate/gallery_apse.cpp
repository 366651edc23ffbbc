/// The apse at the end of the hall, half a cylinder under a quarter of a sphere, and the steps up to it.
#include <algorithm>

#include "data/generate/curves.h"
#include "data/generate/gallery_plan.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

/// Points of the apse's wall, from left to right as seen from the hall, at a radius about (x, z) = (0, end).
std::vector<glm::dvec3> apseRow(double radius, double y) {
  std::vector<glm::dvec3> row;
  for (const glm::dvec2& point : halfCircle(archSegments))
    row.emplace_back(-radius * point.x, y, -halfLength - radius * point.y);
  return row;
}

/// The columns from `first` to `last` of some rows.
Rows columnsOf(const Rows& rows, int first, int last) {
  Rows result;
  for (const std::vector<glm::dvec3>& row : rows) result.emplace_back(row.begin() + first, row.begin() + last + 1);
  return result;
}

}  // namespace

void addApse(std::vector<Group>& groups) {
  const Wall wall = wallAtZ(-halfLength, true);
  const Arch arch{0, apseRadius, apseSpring, apseSpring, archSegments};
  groups.push_back(
      {"apse-arch-wall", "plaster", aroundArch(wall, {-naveSide, naveSide, apseSpring, naveHeight}, arch)});
  for (const double side : {-1.0, 1.0}) {
    const std::string name = side < 0 ? "apse-pier-library" : "apse-pier-gallery";
    const Rectangle pier =
        side < 0 ? Rectangle{-naveSide, -apseRadius, 0, apseSpring} : Rectangle{apseRadius, naveSide, 0, apseSpring};
    const Rectangle steps{side < 0 ? -landingHalf : apseRadius, side < 0 ? -apseRadius : landingHalf, 0, landing};
    groups.push_back({name, "plaster", panels(wall, cutOut(pier, {steps}))});
  }

  const double sill = 1.3, head = 2.4;
  const Rows windowRows{apseRow(apseRadius, sill), apseRow(apseRadius, head)};
  groups.push_back({"apse-wall-lower", "terracotta", sheet({apseRow(apseRadius, landing), apseRow(apseRadius, sill)})});
  groups.push_back(
      {"apse-wall-upper", "terracotta", sheet({apseRow(apseRadius, head), apseRow(apseRadius, apseSpring)})});
  int last = 0, number = 0;
  for (const int first : {2, 7, 12}) {
    const std::string name = std::to_string(++number);
    groups.push_back({"apse-wall-" + name, "terracotta", sheet(columnsOf(windowRows, last, first))});
    groups.push_back({"apse-window-" + name, number == 2 ? "light-amber" : "light-blue",
                      sheet(columnsOf(windowRows, first, first + 2))});
    last = first + 2;
  }
  groups.push_back({"apse-wall-4", "terracotta", sheet(columnsOf(windowRows, last, archSegments))});

  Rows dome;
  for (const glm::dvec2& point : halfCircle(archSegments)) {
    if (point.x < -1e-9) break;
    dome.push_back(apseRow(apseRadius * std::max(point.x, 0.0), apseSpring + apseRadius * point.y));
  }
  groups.push_back({"apse-dome", "azure", sheet(dome)});

  Polygon floor{apseRow(apseRadius, landing)};
  groups.push_back({"apse-floor", "marble", {reversed(floor)}});
}

void addSteps(std::vector<Group>& groups, const std::vector<Rectangle>& holes) {
  Group top{"landing", "marble", {}};
  for (const Rectangle& cell : cutOut({-landingHalf, landingHalf, -halfLength, landingEnd}, holes))
    top.polygons.push_back(rectangle(cell.left, cell.right, cell.bottom, cell.top, landing));
  groups.push_back(top);
  double back = -halfLength, front = landingEnd;
  for (int step = 3; step >= 1; --step) {
    const std::string name = "step-" + std::to_string(step);
    const double y = step * riser;
    if (step < 3) groups.push_back({name, "marble", {rectangle(-landingHalf, landingHalf, back, front, y)}});
    groups.push_back(
        {name + "-riser", "marble", {panel(wallAtZ(front, true), {-landingHalf, landingHalf, y - riser, y})}});
    back = front;
    front += tread;
  }
  for (const bool right : {false, true}) {
    const Wall side = wallAtX(right ? landingHalf : -landingHalf, right);
    Group group{right ? "steps-gallery-side" : "steps-library-side", "marble", {}};
    double end = landingEnd;
    for (int step = 3; step >= 1; --step, end += tread)
      group.polygons.push_back(panel(side, span(side, -halfLength, end, (step - 1) * riser, step * riser)));
    groups.push_back(group);
  }
}

}  // namespace hemitex::data
