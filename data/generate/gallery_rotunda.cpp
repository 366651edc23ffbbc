/// The round room: a drum under a dome with an eye, and the portal from the gallery.
#include "data/generate/curves.h"
#include "data/generate/gallery_plan.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

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

}  // namespace

/// The half width of the portal: it lies between corners 11 and 13 of the room, about corner 12 at -x.
double portalHalfWidth() { return rotundaRadius * circle(rotundaCorners)[11].y; }

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
  const double half = portalHalfWidth();
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

}  // namespace hemitex::data
