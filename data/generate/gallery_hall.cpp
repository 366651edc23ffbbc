/// The hall: arcades on columns, a barrel vault with ribs, tie beams with globes, and the door.
#include <algorithm>

#include "data/generate/curves.h"
#include "data/generate/gallery_plan.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

/// One bay of the wall above the columns, seen from the hall and from the aisle, and the underside of its arch.
void addArcadeBay(std::vector<Group>& groups, const std::string& side, int bay) {
  const std::string name = side + "-arcade-" + std::to_string(bay + 1);
  const double sign = sideSign(side);
  const Arch arch{0, bayLength / 2 - pierHalf, spring, spring, archSegments};
  const Wall inner = wallAtX(sign * naveSide, sign < 0), outer = wallAtX(sign * aisleSide, sign > 0);
  const auto face = [&](const Wall& wall, double top) {
    const Rectangle place = span(wall, bayStart(bay), bayStart(bay + 1), spring, top);
    Arch here = arch;
    here.centre = (place.left + place.right) / 2;
    return aroundArch(wall, place, here);
  };
  groups.push_back({name + "-hall", "plaster", face(inner, naveHeight)});
  groups.push_back({name + "-aisle", "plaster", face(outer, aisleHeight)});
  Arch here = arch;
  here.centre = glm::dot(inner.along, glm::dvec3(bayMiddle(bay)));
  groups.push_back({name + "-soffit", "stone", reveal(inner, outline(here), 2 * pierHalf, false)});
}

/// The half pier at an end of an arcade: down to the floor.
void addEndPier(std::vector<Group>& groups, const std::string& side, double end) {
  const std::string name = side + (end < 0 ? "-pier-apse" : "-pier-door");
  const double sign = sideSign(side), from = end - (end < 0 ? -pierHalf : pierHalf);
  const Wall inner = wallAtX(sign * naveSide, sign < 0), outer = wallAtX(sign * aisleSide, sign > 0);
  groups.push_back({name + "-hall", "plaster", {panel(inner, span(inner, from, end, 0, spring))}});
  groups.push_back({name + "-aisle", "plaster", {panel(outer, span(outer, from, end, 0, spring))}});
  const Wall jamb = wallAtZ(from, end < 0);
  groups.push_back({name, "stone", {panel(jamb, span(jamb, sign * naveSide, sign * aisleSide, 0, spring))}});
}

/// Points of a half circle across the hall, from the right over the crown to the left.
std::vector<glm::dvec3> acrossHall(double radius, double z) {
  std::vector<glm::dvec3> points;
  for (const glm::dvec2& point : halfCircle(vaultSegments))
    points.emplace_back(radius * point.x, naveHeight + radius * point.y, z);
  return points;
}

/// The end of the vault: a ring, and half a disc, which is glass at the door's end.
void addTympanum(std::vector<Group>& groups, const std::string& name, const Wall& wall,
                 const std::string& discMaterial) {
  constexpr double inner = 2;
  const auto arc = [&](double radius) { return outline(Arch{0, radius, naveHeight, naveHeight, vaultSegments}); };
  Rows rows(2);
  for (const glm::dvec2& point : arc(vaultRadius)) rows[0].push_back(wall.at(point.x, point.y));
  for (const glm::dvec2& point : arc(inner)) rows[1].push_back(wall.at(point.x, point.y));
  groups.push_back({name + "-ring", "plaster", sheet(rows)});
  groups.push_back({name + "-disc", discMaterial, {pane(wall, arc(inner), 0)}});
}

}  // namespace

void addArcade(std::vector<Group>& groups, const std::string& side) {
  for (int bay = 0; bay < bays; ++bay) addArcadeBay(groups, side, bay);
  addEndPier(groups, side, -halfLength);
  addEndPier(groups, side, halfLength);
}

void addColumn(std::vector<Group>& groups, const std::string& name, double x, double z) {
  constexpr int corners = 16;
  const double plinth = 0.12, abacus = 2.72;
  const std::vector<ProfilePoint> profile{{0.35, plinth}, {0.385, 0.18}, {0.3, 0.28},
                                          {0.25, 2.38},   {0.29, 2.45},  {0.38, abacus}};
  const Polygon foot = rectangle(x - stripHalf, x + stripHalf, z - stripHalf, z + stripHalf, plinth);
  const Polygon head = atHeight(foot, spring);
  const Polygon pier = rectangle(x - pierHalf, x + pierHalf, z - pierHalf, z + pierHalf, spring);
  groups.push_back({name, "stone", revolved(profile, corners, {x, 0, z})});
  groups.push_back({name + "-plinth", "stone", band(foot, 0)});
  groups.push_back({name + "-plinth-top", "stone", squareWithHole({x, plinth, z}, stripHalf, 0.35, corners)});
  groups.push_back({name + "-abacus", "stone", band(head, abacus)});
  groups.push_back(
      {name + "-abacus-underside", "stone", reversed(squareWithHole({x, abacus, z}, stripHalf, 0.38, corners))});
  groups.push_back({name + "-abacus-top", "stone", frame(head, pier)});
}

void addVault(std::vector<Group>& groups) {
  for (int bay = 0; bay < bays; ++bay) {
    const std::string name = "vault-" + std::to_string(bay + 1);
    const double back = bayStart(bay) + (bay > 0 ? ribHalf : 0);
    const double front = bayStart(bay + 1) - (bay + 1 < bays ? ribHalf : 0);
    groups.push_back({name, "vault", sheet({acrossHall(vaultRadius, front), acrossHall(vaultRadius, back)})});
    for (const double side : {-1.0, 1.0}) {
      const double low = std::min(side * ribRadius, side * vaultRadius);
      groups.push_back({name + (side < 0 ? "-ledge-library" : "-ledge-gallery"),
                        "stone",
                        {rectangle(low, low + (vaultRadius - ribRadius), back, front, naveHeight)}});
    }
    if (bay == 0) continue;
    const double z = bayStart(bay);
    const std::string rib = "rib-" + std::to_string(bay);
    groups.push_back({rib, "stone", sheet({acrossHall(ribRadius, z + ribHalf), acrossHall(ribRadius, z - ribHalf)})});
    groups.push_back({rib + "-apse-side", "stone",
                      sheet({acrossHall(ribRadius, z - ribHalf), acrossHall(vaultRadius, z - ribHalf)})});
    groups.push_back({rib + "-door-side", "stone",
                      sheet({acrossHall(vaultRadius, z + ribHalf), acrossHall(ribRadius, z + ribHalf)})});
  }
  addTympanum(groups, "apse-tympanum", wallAtZ(-halfLength, true), "plaster");
  addTympanum(groups, "door-tympanum", wallAtZ(halfLength, false), "light-window");
}

void addTieBeam(std::vector<Group>& groups, const std::string& name, double z) {
  constexpr double half = 0.045, beamTop = 4.55, beamFoot = beamTop - 2 * half, globeTop = 3.95;
  Rows rows(2);
  for (const glm::dvec2& corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
    const double y = beamTop - half + half * corner.y;
    rows[0].emplace_back(naveSide, y, z + half * corner.x);
    rows[1].emplace_back(-naveSide, y, z + half * corner.x);
  }
  groups.push_back({name, "iron", sheet(rows)});
  groups.push_back({name + "-rod", "iron", band(disc({0, beamFoot, z}, 0.012, 4), globeTop)});
  groups.push_back({name + "-cap", "brass", revolved({{0.07, -0.06}, {0.06, 0}, {0, 0}}, 12, {0, globeTop, z})});
  std::vector<ProfilePoint> globe;
  const std::vector<glm::dvec2> arc = circle(12);
  for (int i = 0; i <= 5; ++i) {
    const glm::dvec2 point = arc[static_cast<std::size_t>((i + 9) % 12)];
    globe.push_back({std::max(0.0, 0.23 * point.x), -0.28 + 0.23 * point.y});
  }
  globe.push_back({0.07, -0.06});
  globe[0].radius = 0;
  groups.push_back({name + "-globe", "light-globe", revolved(globe, 12, {0, globeTop, z})});
}

void addDoor(std::vector<Group>& groups) {
  const Wall wall = wallAtZ(halfLength, false);
  const Rectangle place{-naveSide, naveSide, 0, naveHeight}, hole{-0.95, 0.95, 0, 2.7};
  groups.push_back({"door-wall", "plaster", panels(wall, cutOut(place, {hole}))});
  groups.push_back({"door-reveal", "stone", reveal(wall, outline(hole), 0.3, true)});
  Wall leaf = wall;
  leaf.origin = wall.at(0, 0, 0.3);
  const std::vector<Rectangle> panelled{
      {-0.8, -0.15, 0.2, 1.2}, {0.15, 0.8, 0.2, 1.2}, {-0.8, -0.15, 1.35, 2.5}, {0.15, 0.8, 1.35, 2.5}};
  groups.push_back({"door-frame", "walnut", panels(leaf, cutOut(hole, panelled))});
  int number = 0;
  for (const Rectangle& inset : panelled) {
    const std::string name = "door-panel-" + std::to_string(++number);
    groups.push_back({name, "walnut", {panel(leaf, inset, 0.03)}});
    groups.push_back({name + "-edge", "walnut", reveal(leaf, outline(inset), 0.03, true)});
  }
}

}  // namespace hemitex::data
