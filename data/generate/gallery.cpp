/// The complex scene: a vaulted hall between a library and a picture gallery, with an apse and a domed round room.
///
/// Every part is built for itself, and closeSeams puts the vertices of neighbours into each other's edges, so the rooms
/// are closed to the last pixel. x points to the gallery's side and -z to the apse; lengths are metres, made up.
#include <algorithm>
#include <cstdint>

#include "data/generate/curves.h"
#include "data/generate/furniture.h"
#include "data/generate/models.h"
#include "data/generate/seams.h"
#include "data/generate/shapes.h"
#include "data/generate/walls.h"

namespace hemitex::data {
namespace {

// The plan: four bays, an arcade of two walls' thickness to each side, aisles behind it.
constexpr int bays = 4;
constexpr double bayLength = 3.4, halfLength = bays * bayLength / 2;
constexpr double naveSide = 3, aisleSide = 3.6, outerSide = 6.6;  // the wall of the arcade stands between the first two
constexpr double pierHalf = (aisleSide - naveSide) / 2, pierMiddle = (naveSide + aisleSide) / 2;
constexpr double stripHalf = 0.42;  // of plinths and abaci

// Heights.
constexpr double spring = 2.9, aisleHeight = 4.5, naveHeight = 4.8;
constexpr double ribRadius = 3, vaultRadius = 3.15, ribHalf = 0.25;
constexpr int archSegments = 16, vaultSegments = 16;

// The landing before the apse, with three risers.
constexpr double landing = 0.45, riser = 0.15, tread = 0.35, landingHalf = 2.4, landingEnd = -halfLength + 1.4;
constexpr double apseRadius = 2, apseSpring = 2.7;

// The round room, and its bay.
constexpr double rotundaRadius = 2.4, rotundaX = 9.2, rotundaZ = -bayLength / 2, portalHeight = 2.5, drumHeight = 3;
// Bays of the library.
constexpr int bookcaseBay = 1, paintedBay = 3;

constexpr int rotundaCorners = 24;

double bayMiddle(int bay) { return (bay + 0.5) * bayLength - halfLength; }
double bayStart(int bay) { return bay * bayLength - halfLength; }
double sideSign(const std::string& side) { return side == "library" ? -1 : 1; }

Wall wallAtX(double x, bool facesRight) { return {{x, 0, 0}, facesRight ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 0, 1)}; }
Wall wallAtZ(double z, bool facesViewer) {
  return {{0, 0, z}, facesViewer ? glm::dvec3(1, 0, 0) : glm::dvec3(-1, 0, 0)};
}

/// A span along a wall, whichever way its s runs.
Rectangle span(const Wall& wall, double from, double to, double bottom, double top) {
  const double a = glm::dot(wall.along, glm::dvec3(from)), b = glm::dot(wall.along, glm::dvec3(to));
  return {std::min(a, b), std::max(a, b), bottom, top};
}

void append(std::vector<Group>& groups, const std::vector<Group>& more) {
  groups.insert(groups.end(), more.begin(), more.end());
}

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

/// A column on a square plinth, with a swelling shaft, under an abacus that the arcade's wall stands on.
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

/// Points of a half circle across the hall, from the right over the crown to the left.
std::vector<glm::dvec3> acrossHall(double radius, double z) {
  std::vector<glm::dvec3> points;
  for (const glm::dvec2& point : halfCircle(vaultSegments))
    points.emplace_back(radius * point.x, naveHeight + radius * point.y, z);
  return points;
}

/// The vault of a bay, between the ribs, and the ledges that it springs from; ribs stand over the columns.
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
}

/// What fills the end of the vault: a ring, and half a disc, which is glass at the door's end.
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

/// The tie beams of the hall, and a globe hanging from each.
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

/// A wall's part with a tall window of five panes: wall, reveal, glass and bars.
void addWindow(std::vector<Group>& groups, const std::string& name, const Wall& wall, const Rectangle& place,
               const std::string& material) {
  constexpr double depth = 0.3, bar = 0.03;
  const double middle = (place.left + place.right) / 2;
  const Arch arch{middle, 0.7, 1, 2.7, 10};
  groups.push_back({name + "-wall", material, aroundArch(wall, {place.left, place.right, arch.sill, place.top}, arch)});
  groups.push_back({name + "-below", material, {panel(wall, {place.left, place.right, place.bottom, arch.sill})}});
  groups.push_back({name + "-reveal", "stone", reveal(wall, outline(arch), depth, true)});
  const Rectangle lower{middle - arch.radius, middle + arch.radius, arch.sill, arch.spring};
  const double half = (arch.sill + arch.spring) / 2;
  const std::vector<Rectangle> panes{{lower.left, middle - bar, lower.bottom, half - bar},
                                     {middle + bar, lower.right, lower.bottom, half - bar},
                                     {lower.left, middle - bar, half + bar, lower.top - 2 * bar},
                                     {middle + bar, lower.right, half + bar, lower.top - 2 * bar}};
  groups.push_back({name + "-bars", "iron", panels(wall, cutOut(lower, panes), depth)});
  int number = 0;
  for (const Rectangle& glass : panes)
    groups.push_back({name + "-pane-" + std::to_string(++number), "light-window", {panel(wall, glass, depth)}});
  Arch head = arch;
  head.sill = head.spring;
  groups.push_back({name + "-head", "light-window", {pane(wall, outline(head), depth)}});
}

/// The upright pieces and boards of two built-in bookcases, and the wall around them.
std::vector<Rectangle> addBookcases(std::vector<Group>& groups, const std::string& name, const Wall& wall,
                                    const Rectangle& place) {
  constexpr double depth = 0.32, stile = 0.08, board = 0.05, base = 0.25, shelfHeight = 0.45;
  constexpr int shelves = 5;
  const double middle = (place.left + place.right) / 2, half = 1.5, height = base + shelves * (shelfHeight + board);
  const Rectangle whole{middle - half, middle + half, 0, height};
  groups.push_back({name + "-wall", "sage", panels(wall, cutOut(place, {whole}))});
  std::vector<Rectangle> niches;
  for (const double s : {whole.left, middle - stile / 2, whole.right - stile})
    groups.push_back(
        {name + "-stile-" + std::to_string(groups.size()), "walnut", {panel(wall, {s, s + stile, 0, height})}});
  for (const double left : {whole.left + stile, middle + stile / 2}) {
    const double right = left + half - 1.5 * stile;
    groups.push_back(
        {name + "-base-" + std::to_string(groups.size()), "walnut", {panel(wall, {left, right, 0, base})}});
    for (int shelf = 0; shelf < shelves; ++shelf) {
      const double bottom = base + shelf * (shelfHeight + board);
      niches.push_back({left, right, bottom, bottom + shelfHeight});
      const std::string number = std::to_string(niches.size());
      groups.push_back({name + "-board-" + number,
                        "walnut",
                        {panel(wall, {left, right, bottom + shelfHeight, bottom + shelfHeight + board})}});
      groups.push_back({name + "-niche-" + number, "walnut", reveal(wall, outline(niches.back()), depth, true)});
      groups.push_back({name + "-niche-back-" + number, "walnut", {panel(wall, niches.back(), depth)}});
    }
  }
  return niches;
}

/// A part of the wall with a hole for a painting.
void addPaintedWall(std::vector<Group>& groups, const std::string& name, const Wall& wall, const Rectangle& place,
                    const std::string& material, double width, double height, const std::vector<ColourPatch>& canvas) {
  const double middle = (place.left + place.right) / 2, eyeHeight = 1.75;
  const Rectangle hole{middle - width / 2, middle + width / 2, eyeHeight - height / 2, eyeHeight + height / 2};
  groups.push_back({name + "-wall", material, panels(wall, cutOut(place, {hole}))});
  append(groups, placed(painting(wall, hole, "gilt", canvas), name, {0, 0, 0}));
}

/// The door at the end of the hall, opposite the apse: two leaves with two panels each.
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

/// Points of the apse's wall, from the left to the right as seen from the hall, at a radius about (x, z) = (0, end).
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

/// The end wall with the arch, the steps and the landing, and the apse with three windows of coloured glass.
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

/// Three risers up to the landing.
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

/// Points of a circle about the round room's axis, from corner `first` clockwise (from the left to the right as seen
/// from inside) over `count` edges.
std::vector<glm::dvec3> rotundaRow(double radius, double y, int first, int count) {
  const std::vector<glm::dvec2> points = circle(rotundaCorners);
  std::vector<glm::dvec3> row;
  for (int i = 0; i <= count; ++i) {
    const glm::dvec2 point = points[static_cast<std::size_t>((first - i + 2 * rotundaCorners) % rotundaCorners)];
    row.emplace_back(rotundaX + radius * point.x, y, rotundaZ - radius * point.y);
  }
  return row;
}

/// The half width of the portal: it lies between corners 11 and 13 of the room, about corner 12 at -x.
double portalHalf() { return rotundaRadius * circle(rotundaCorners)[11].y; }

void addRotunda(std::vector<Group>& groups) {
  constexpr int portalFirst = 11, portalEdges = 2;
  const int wallEdges = rotundaCorners - portalEdges;
  const auto row = [](double radius, double y, int first, int count) { return rotundaRow(radius, y, first, count); };
  groups.push_back({"rotunda-wall", "pompeian",
                    sheet({row(rotundaRadius, 0, portalFirst, wallEdges),
                           row(rotundaRadius, portalHeight, portalFirst, wallEdges)})});
  groups.push_back({"rotunda-frieze", "marble",
                    sheet({row(rotundaRadius, portalHeight, 0, rotundaCorners),
                           row(rotundaRadius, drumHeight, 0, rotundaCorners)})});

  Rows dome;
  const std::vector<glm::dvec2> meridian = circle(20);
  for (std::size_t i = 0; i <= 4; ++i)
    dome.push_back(row(rotundaRadius * meridian[i].x, drumHeight + rotundaRadius * meridian[i].y, 0, rotundaCorners));
  const double eyeRadius = rotundaRadius * meridian[4].x, eyeHeight = drumHeight + rotundaRadius * meridian[4].y;
  groups.push_back({"rotunda-dome", "azure", sheet(dome)});
  groups.push_back(
      {"rotunda-eye", "marble",
       sheet({row(eyeRadius, eyeHeight, 0, rotundaCorners), row(eyeRadius, eyeHeight + 0.4, 0, rotundaCorners)})});
  const glm::dvec3 axis{rotundaX, 0, rotundaZ};
  groups.push_back({"rotunda-sky",
                    "light-eye",
                    {reversed(disc(axis + glm::dvec3(0, eyeHeight + 0.4, 0), eyeRadius, rotundaCorners))}});

  const double inner = 1.3, pedestal = 0.42, pedestalHeight = 0.8;
  groups.push_back({"rotunda-floor", "tile-dark",
                    ring(disc(axis, rotundaRadius, rotundaCorners), disc(axis, inner, rotundaCorners))});
  groups.push_back({"rotunda-floor-middle", "tile-light",
                    ring(disc(axis, inner, rotundaCorners), disc(axis, pedestal, rotundaCorners / 2))});
  const Polygon top = disc(axis + glm::dvec3(0, pedestalHeight, 0), pedestal, rotundaCorners / 2);
  const std::vector<ProfilePoint> vase = roundVase(0.95);
  groups.push_back({"rotunda-pedestal", "marble", band(top, 0)});
  groups.push_back({"rotunda-pedestal-top", "marble",
                    ring(top, disc(axis + glm::dvec3(0, pedestalHeight, 0), vase[0].radius, rotundaCorners / 2))});
  groups.push_back(
      {"rotunda-vase", "cobalt", revolved(vase, rotundaCorners / 2, axis + glm::dvec3(0, pedestalHeight, 0))});

  // The portal: jambs, and floor and ceiling between the gallery's wall and the arc of the round one.
  const std::vector<glm::dvec3> arc = rotundaRow(rotundaRadius, 0, portalFirst + portalEdges, portalEdges);
  const double half = portalHalf();
  const glm::dvec3 near{outerSide, 0, rotundaZ + half}, far{outerSide, 0, rotundaZ - half};
  Group floor{"portal-floor", "tile-light", {}};
  floor.polygons = {{{near, arc[0], arc[1]}}, {{near, arc[1], far}}, {{far, arc[1], arc[2]}}};
  Group ceiling{"portal-ceiling", "stone", {}};
  for (const Polygon& polygon : floor.polygons) ceiling.polygons.push_back(reversed(atHeight(polygon, portalHeight)));
  groups.push_back(floor);
  groups.push_back(ceiling);
  const Wall nearJamb = wallAtZ(rotundaZ + half, false), farJamb = wallAtZ(rotundaZ - half, true);
  groups.push_back(
      {"portal-jamb-door", "stone", {panel(nearJamb, span(nearJamb, outerSide, arc[0].x, 0, portalHeight))}});
  groups.push_back(
      {"portal-jamb-apse", "stone", {panel(farJamb, span(farJamb, outerSide, arc[0].x, 0, portalHeight))}});
}

/// The floor inside `area`, (x, z) from left to right and from back to front, without what stands on it.
void addFloor(std::vector<Group>& groups, const std::string& name, const std::string& material, const Rectangle& area,
              const std::vector<Rectangle>& holes) {
  std::vector<Rectangle> inside;
  for (const Rectangle& hole : holes) {
    const Rectangle shared{std::max(hole.left, area.left), std::min(hole.right, area.right),
                           std::max(hole.bottom, area.bottom), std::min(hole.top, area.top)};
    if (shared.left < shared.right && shared.bottom < shared.top) inside.push_back(shared);
  }
  Group group{name, material, {}};
  for (const Rectangle& cell : cutOut(area, inside))
    group.polygons.push_back(rectangle(cell.left, cell.right, cell.bottom, cell.top, 0));
  if (!group.polygons.empty()) groups.push_back(group);
}

/// Tiles of half a bay: a chequer in the hall, boards in the library, tiles in the gallery, stone under the arcades.
void addFloors(std::vector<Group>& groups, const std::vector<Rectangle>& holes) {
  const double strip = pierMiddle - stripHalf, beyond = pierMiddle + stripHalf;
  const auto add = [&](const std::string& name, double from, double to, int columns, const std::string& even,
                       const std::string& odd) {
    for (int row = 0; row < 2 * bays; ++row)
      for (int column = 0; column < columns; ++column) {
        const double width = (to - from) / columns, left = from + column * width,
                     back = bayLength / 2 * row - halfLength;
        addFloor(groups, name + '-' + std::to_string(row + 1) + '-' + std::to_string(column + 1),
                 (row + column) % 2 == 0 ? even : odd,
                 {left, column + 1 == columns ? to : left + width, back, back + bayLength / 2}, holes);
      }
  };
  add("floor", -strip, strip, 4, "tile-light", "tile-dark");
  add("library-floor", -outerSide, -beyond, 2, "oak", "oak");
  add("gallery-floor", beyond, outerSide, 2, "tile-light", "tile-warm");
  add("library-strip", -beyond, -strip, 1, "stone", "stone");
  add("gallery-strip", strip, beyond, 1, "stone", "stone");
}

/// The aisle's ceiling, with a coffer in each bay, lit in the gallery.
void addCeiling(std::vector<Group>& groups, const std::string& side, const std::string& cofferMaterial) {
  const double sign = sideSign(side), depth = 0.25, inset = 0.7;
  const double left = std::min(sign * aisleSide, sign * outerSide),
               right = std::max(sign * aisleSide, sign * outerSide);
  for (int bay = 0; bay < bays; ++bay) {
    const std::string name = side + "-ceiling-" + std::to_string(bay + 1);
    const double back = bayStart(bay), front = bayStart(bay + 1);
    const Polygon outer = rectangle(left, right, back, front, aisleHeight);
    const Polygon inner = rectangle(left + inset, right - inset, back + inset, front - inset, aisleHeight);
    const Polygon top = atHeight(inner, aisleHeight + depth);
    groups.push_back({name, "plaster", reversed(frame(outer, inner))});
    groups.push_back({name + "-coffer-sides", "plaster", reversed(band(top, aisleHeight))});
    groups.push_back({name + "-coffer", cofferMaterial, {reversed(top)}});
  }
}

// Compositions of the paintings.
std::vector<ColourPatch> blueCanvas() {
  return {{{0, 0.3, 0, 0.55}, "cobalt"},   {{0, 0.3, 0.55, 1}, "tile-light"}, {{0.3, 0.75, 0, 0.25}, "gilt"},
          {{0.3, 0.75, 0.25, 1}, "azure"}, {{0.75, 1, 0, 0.7}, "ivory"},      {{0.75, 1, 0.7, 1}, "pompeian"}};
}
std::vector<ColourPatch> redCanvas() {
  return {{{0, 0.62, 0.4, 1}, "pompeian"},
          {{0, 0.2, 0, 0.4}, "ivory"},
          {{0.2, 0.62, 0, 0.4}, "cobalt"},
          {{0.62, 1, 0.75, 1}, "gilt"},
          {{0.62, 1, 0, 0.75}, "ivory"}};
}
std::vector<ColourPatch> greenCanvas() {
  return {{{0, 1, 0, 0.3}, "bottle"},
          {{0, 1, 0.3, 0.45}, "celadon"},
          {{0, 0.55, 0.45, 1}, "ivory"},
          {{0.55, 0.8, 0.45, 1}, "gilt"},
          {{0.8, 1, 0.45, 1}, "terracotta"}};
}

void addLibraryWalls(std::vector<Group>& groups) {
  const Wall wall = wallAtX(-outerSide, true);
  for (int bay = 0; bay < bays; ++bay) {
    const std::string name = "library-" + std::to_string(bay + 1);
    const Rectangle place = span(wall, bayStart(bay), bayStart(bay + 1), 0, aisleHeight);
    if (bay == bookcaseBay)
      addBookcases(groups, name + "-bookcases", wall, place);
    else if (bay == paintedBay)
      addPaintedWall(groups, name, wall, place, "sage", 1.5, 2, greenCanvas());
    else
      addWindow(groups, name + "-window", wall, place, "sage");
  }
  for (const bool apseEnd : {true, false}) {
    const Wall end = wallAtZ(apseEnd ? -halfLength : halfLength, apseEnd);
    addWindow(groups, apseEnd ? "library-window-apse" : "library-window-door", end,
              span(end, -outerSide, -aisleSide, 0, aisleHeight), "sage");
  }
}

void addGalleryWalls(std::vector<Group>& groups) {
  const Wall wall = wallAtX(outerSide, false);
  const auto place = [&](int bay) { return span(wall, bayStart(bay), bayStart(bay + 1), 0, aisleHeight); };
  addPaintedWall(groups, "gallery-1", wall, place(0), "ochre", 2, 1.5, redCanvas());
  const double half = portalHalf();
  groups.push_back({"gallery-2-wall", "ochre",
                    panels(wall, cutOut(place(1), {span(wall, rotundaZ - half, rotundaZ + half, 0, portalHeight)}))});
  addPaintedWall(groups, "gallery-3", wall, place(2), "ochre", 1.5, 2, greenCanvas());
  addPaintedWall(groups, "gallery-4", wall, place(3), "ochre", 2.2, 1.4, blueCanvas());
  for (const bool apseEnd : {true, false}) {
    const Wall end = wallAtZ(apseEnd ? -halfLength : halfLength, apseEnd);
    addWindow(groups, apseEnd ? "gallery-window-apse" : "gallery-window-door", end,
              span(end, aisleSide, outerSide, 0, aisleHeight), "ochre");
  }
}

struct Pedestal {
  std::string name;
  glm::dvec3 foot{0.0};
  double halfSide = 0, height = 0;
  std::vector<ProfilePoint> vase;
  std::string material;
};

std::vector<Pedestal> pedestals() {
  return {{"landing", {0, landing, -6.1}, 0.32, 0.85, bowl(0.5), "celadon"},
          {"gallery-1", {5.3, 0, -5.1}, 0.24, 1, slenderVase(0.9), "cobalt"}};
}

Rectangle footprint(const Pedestal& pedestal) {
  return {pedestal.foot.x - pedestal.halfSide, pedestal.foot.x + pedestal.halfSide, pedestal.foot.z - pedestal.halfSide,
          pedestal.foot.z + pedestal.halfSide};
}

/// The closed rooms, with everything that is cut into them.
std::vector<Group> rooms() {
  std::vector<Group> groups;
  std::vector<Rectangle> floorHoles{{-landingHalf, landingHalf, -halfLength, landingEnd + 2 * tread}}, landingHoles;
  for (const Pedestal& pedestal : pedestals())
    (pedestal.foot.y > 0 ? landingHoles : floorHoles).push_back(footprint(pedestal));
  for (const double x : {-aisleSide, naveSide})
    for (const double z : {-halfLength, halfLength - pierHalf})
      floorHoles.push_back({x, x + 2 * pierHalf, z, z + pierHalf});
  for (int column = 1; column < bays; ++column)
    for (const double side : {-1.0, 1.0}) {
      const double x = side * pierMiddle, z = bayStart(column);
      floorHoles.push_back({x - stripHalf, x + stripHalf, z - stripHalf, z + stripHalf});
      addColumn(groups, (side < 0 ? "library-column-" : "gallery-column-") + std::to_string(column), x, z);
    }
  for (const std::string side : {"library", "gallery"}) {
    for (int bay = 0; bay < bays; ++bay) addArcadeBay(groups, side, bay);
    addEndPier(groups, side, -halfLength);
    addEndPier(groups, side, halfLength);
  }
  addVault(groups);
  addTympanum(groups, "apse-tympanum", wallAtZ(-halfLength, true), "plaster");
  addTympanum(groups, "door-tympanum", wallAtZ(halfLength, false), "light-window");
  addDoor(groups);
  addApse(groups);
  addSteps(groups, landingHoles);
  addRotunda(groups);
  addFloors(groups, floorHoles);
  addCeiling(groups, "library", "plaster");
  addCeiling(groups, "gallery", "light-coffer");
  addLibraryWalls(groups);
  addGalleryWalls(groups);
  for (const Pedestal& pedestal : pedestals())
    append(groups,
           placed(vaseOnPedestal(pedestal.halfSide, pedestal.height, pedestal.vase, "marble", pedestal.material),
                  pedestal.name, pedestal.foot));
  closeSeams(groups, 1e4);
  return groups;
}

/// Rows of books of many sizes and colours, always the same.
void addBooks(std::vector<Group>& groups) {
  const Wall wall = wallAtX(-outerSide, true);
  const std::vector<std::string> colours{"pompeian", "bottle", "cobalt", "ivory", "gilt", "walnut", "terracotta"};
  std::uint32_t state = 110;  // one of those that make the model 8088 triangles
  const auto next = [&](std::uint32_t below) { return (state = state * 1664525u + 1013904223u) / 65536u % below; };
  std::vector<Group> built;
  const Rectangle place = span(wall, bayStart(bookcaseBay), bayStart(bookcaseBay + 1), 0, aisleHeight);
  int shelf = 0;
  for (const Rectangle& niche : addBookcases(built, "", wall, place)) {
    std::vector<Book> row;
    const double room = (niche.right - niche.left) * (0.45 + 0.05 * next(9));
    for (double used = 0; used < room;) {
      row.push_back({0.07 + 0.005 * next(12), 0.24 + 0.02 * next(9), colours[next(7)]});
      used += row.back().width;
      if (used > room) row.pop_back();
    }
    const double front = 0.04 + 0.01 * next(4);
    append(groups, placed(books(wall, niche, front, 0.32, row), "shelf-" + std::to_string(++shelf), {0, 0, 0}));
  }
}

void addFurniture(std::vector<Group>& groups) {
  const auto addTable = [&](const std::string& name, double x, double z, double length) {
    append(groups, placed(tableWithLamp(length, "walnut"), name, {x, 0, z}, {0, 1}));
  };
  const auto addChair = [&](const std::string& name, double x, double z, const glm::dvec2& turn) {
    append(groups, placed(chair("oak"), name, {x, 0, z}, turn));
  };
  int number = 0;
  for (const double z : {2.2, -1.5}) {
    const std::string table = "table-" + std::to_string(++number);
    addTable(table, 0, z, 2.2);
    addChair(table + "-chair-1", -0.62, z - 0.5, {0, 1});
    addChair(table + "-chair-2", 0.64, z + 0.5, {0, -1});
  }
  // Of these one was pulled out.
  addChair("table-1-chair-3", -0.66, 2.7, {0, 1});
  addChair("table-1-chair-4", 1.05, 1.6, {0.28, -0.96});
  append(groups, placed(bench("oak", "stone"), "gallery-bench-1", {4.7, 0, -3.6}, {0, 1}));
  append(groups, placed(bench("oak", "stone"), "gallery-bench-2", {4.7, 0, 2.4}, {0, 1}));
  append(groups, placed(bench("oak", "stone"), "library-bench", {-5.2, 0, 1.7}, {0, 1}));
  for (int beam = 1; beam < bays; ++beam) addTieBeam(groups, "beam-" + std::to_string(beam), bayStart(beam));
}

}  // namespace

Model gallery() {
  Model model;
  model.name = "gallery";
  model.about = {
      "A vaulted hall between a library and a picture gallery, with an apse and a domed round room: 8088 triangles.",
      "Curved parts bring charts along: texture coordinates that fill [0,1]^2 or a part of it without overlap.",
      "Lengths, in metres, are made up. Written by hemitex_data.",
  };
  model.aboutMaterials = {
      "The materials of the gallery, made up. Kd is diffuse reflectance, Ke emitted radiosity, both linear sRGB.",
      "Windows give daylight, globes and bulbs are warm. Written by hemitex_data.",
  };
  model.materials = {{"plaster", {0.78, 0.75, 0.69}},
                     {"vault", {0.74, 0.76, 0.78}},
                     {"stone", {0.68, 0.63, 0.55}},
                     {"marble", {0.8, 0.79, 0.77}},
                     {"tile-light", {0.7, 0.66, 0.58}},
                     {"tile-dark", {0.15, 0.22, 0.22}},
                     {"tile-warm", {0.55, 0.4, 0.3}},
                     {"oak", {0.56, 0.38, 0.22}},
                     {"walnut", {0.34, 0.19, 0.1}},
                     {"sage", {0.44, 0.52, 0.4}},
                     {"ochre", {0.76, 0.6, 0.36}},
                     {"terracotta", {0.66, 0.3, 0.17}},
                     {"pompeian", {0.58, 0.12, 0.08}},
                     {"azure", {0.2, 0.38, 0.62}},
                     {"cobalt", {0.06, 0.14, 0.5}},
                     {"celadon", {0.5, 0.7, 0.58}},
                     {"bottle", {0.08, 0.28, 0.16}},
                     {"ivory", {0.8, 0.74, 0.6}},
                     {"gilt", {0.72, 0.52, 0.18}},
                     {"brass", {0.6, 0.46, 0.2}},
                     {"iron", {0.1, 0.1, 0.11}},
                     {"shade", {0.78, 0.7, 0.52}},
                     {"light-window", glm::dvec3{0.3}, {9, 11, 13.5}},
                     {"light-eye", glm::dvec3{0.3}, {36, 40, 45}},
                     {"light-amber", glm::dvec3{0.3}, {9, 4.2, 0.9}},
                     {"light-blue", glm::dvec3{0.3}, {1.2, 3, 9}},
                     {"light-coffer", glm::dvec3{0.6}, {6, 5.4, 4.4}},
                     {"light-globe", glm::dvec3{0.6}, {26, 20, 13}},
                     {"light-bulb", glm::dvec3{0.6}, {70, 50, 28}}};
  model.groups = rooms();
  addBooks(model.groups);
  addFurniture(model.groups);
  model.view = {{0.7, 1.7, 6.3}, {-0.1, 2, -6}, {0, 1, 0}, 62};
  return model;
}

}  // namespace hemitex::data
