#include "tests/accuracy/form_factor_cases.h"

#include <cmath>
#include <numbers>

#include "reference/truth/closed_forms/polygon_to_polygon.h"
#include "tests/accuracy/numbers.h"
#include "tests/support/hand_scenes.h"
#include "tests/truth/rectangles.h"

namespace hemitex::accuracy {
namespace {

using radiosity::Surface;
using tests::AxisRectangle;

const AxisRectangle unitSquare{{0, 1}, {0, 1}};
const std::string c11 = "Howell C-11", c14 = "Howell C-14", unequal = "Ehlert and Smith 1993";

/// The rectangle `from` in the plane z = 0, facing up.
Surface facingUp(const AxisRectangle& from) {
  return tests::parallelogram("under", {from.first.low, from.second.low, 0}, {from.first.high - from.first.low, 0, 0},
                              {0, from.second.high - from.second.low, 0});
}
/// The rectangle `to` in the plane z = gap, facing down.
Surface facingDown(const AxisRectangle& to, double gap) {
  return tests::parallelogram("over", {to.first.low, to.second.low, gap}, {0, to.second.high - to.second.low, 0},
                              {to.first.high - to.first.low, 0, 0});
}
/// The rectangle `to` (x, z) in the plane y = 0, facing along y.
Surface facingAlongY(const AxisRectangle& to) {
  return tests::parallelogram("wall", {to.first.low, 0, to.second.low}, {0, 0, to.second.high - to.second.low},
                              {to.first.high - to.first.low, 0, 0});
}

FormFactorCase parallel(const std::string& name, const std::string& truth, const AxisRectangle& from,
                        const AxisRectangle& to, double gap) {
  return {name, truth, {facingUp(from), facingDown(to, gap)}, tests::parallelRectangles(from, to, gap)};
}

FormFactorCase perpendicular(const std::string& name, const std::string& truth, const AxisRectangle& from,
                             const AxisRectangle& to) {
  return {name, truth, {facingUp(from), facingAlongY(to)}, tests::perpendicularRectangles(from, to)};
}

}  // namespace

FormFactorTheme gaps() {
  FormFactorTheme theme{"Gaps",
                        R"(Two unit squares face each other. The case is their distance in sides.

With a gap of 1e-6, light escapes through a rim that is too narrow for any sample. The standard error of aimed rays does
not include it. They are wrong by the flux through the rim, which is less than 4e-6.

The eye of a hemicube lies above its surface by 2^-21 of the scene's extent, so that rounding to binary32 cannot move it
below. A surface nearer than that is behind the eye. Use rays for such gaps, or leave out distant objects.)",
                        {}};
  const auto add = [&](const std::string& name, double gap) {
    theme.cases.push_back(parallel(name, c11, unitSquare, unitSquare, gap));
    if (4 * gap * raySamples < 1) theme.cases.back().rim = 4 * gap;
  };
  for (const double gap : {1e-6, 1e-4, 0.01, 0.1, 1.0, 10.0, 100.0, 1e4}) add(numberText(gap), gap);
  add("1e-6, in a scene of 100 sides", 1e-6);
  theme.cases.back().surfaces.push_back(facingUp({{100, 101}, {0, 1}}));
  return theme;
}

FormFactorTheme slivers() {
  const AxisRectangle sliver{{0, 1}, {0, 1e-6}}, middle{{0, 1}, {0.5, 0.500001}};
  FormFactorCase near = parallel("from sliver to sliver, one width away", c11, sliver, sliver, 1e-6);
  near.rim = 2e-6;  // the two open ends are 1e-6 wide and high, the sliver has an area of 1e-6
  return {"Slivers",
          R"(Rectangles of 1 : 1e-6, and unit squares.

The eye of a hemicube lies above its surface by 2^-21 of the scene's extent, which here is half the width of a sliver.
The values in the last two rows are right for that eye.

Between slivers one width apart, at most 2e-6 of the flux leaves at the ends. Samples that miss the ends miss it, and the
standard error of aimed rays does not include it.)",
          {parallel("from a square to a sliver over its middle, one side away", unequal, unitSquare, middle, 1),
           parallel("from that sliver to the square", unequal, middle, unitSquare, 1),
           parallel("from sliver to sliver, one length away", c11, sliver, sliver, 1), near,
           perpendicular("slivers at a right angle along the long edge", c14, sliver, sliver)}};
}

FormFactorTheme touching() {
  return {"Shared edges and touching corners",
          "Unit squares at a right angle.",
          {perpendicular("an edge", c14, unitSquare, unitSquare),
           perpendicular("a part of an edge, of a wall of 2.75 x 2", unequal, unitSquare, {{0.25, 3}, {0, 2}}),
           perpendicular("a corner", unequal, unitSquare, {{1, 2}, {0, 1}}),
           perpendicular("all but an edge: 1e-6 away from it", unequal, unitSquare, {{0, 1}, {1e-6, 1}})}};
}

/// A prism of length 1 over an isosceles triangle, whose first two faces are unit squares.
FormFactorTheme angles() {
  FormFactorTheme theme{
      "Dihedral angles",
      R"(Two unit squares share an edge; a third rectangle and two triangles close the prism. No light of the first square is
lost: no sample of rays over the hemisphere or of hemicubes meets a back or the background.)",
      {}};
  for (const int degrees : {1, 5, 45, 90, 135, 175, 179}) {
    const double angle = degrees * std::numbers::pi / 180;
    const glm::dvec3 a(0), b(1, 0, 0), c(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    const Surface first = tests::quad("first", {a, a + up, b + up, b});
    const Surface second = tests::quad("second", {c, c + up, a + up, a});
    const auto end = [](const std::string& name, const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
      return tests::surfaceOf(name, {tests::triangleOf({p, {0, 0}}, {q, {1, 0}}, {r, {0, 1}})});
    };
    const std::vector<glm::dvec3> from{a, a + up, b + up, b}, third{b, b + up, c + up, c}, low{a, b, c};
    const double toOthers = reference::polygonToPolygon(from, third) + 2 * reference::polygonToPolygon(from, low);
    theme.cases.push_back({std::to_string(degrees) + (degrees == 1 ? " degree" : " degrees"),
                           "a closed prism: 1 less the others",
                           {first, second, tests::quad("third", {b, b + up, c + up, c}), end("low", a, b, c),
                            end("high", a + up, c + up, b + up)},
                           1 - toOthers});
  }
  return theme;
}

FormFactorTheme blockers() {
  FormFactorTheme theme{
      "Blockers of zero thickness",
      R"(Two unit squares face each other. Halfway between them a sheet covers x < 1/2 and y < 1/2, or x < 1/2, or all. Lines
from square to square cross the middle plane equally often on both sides. So the sheet hides a quarter, a half or all.
The one hemicube gives exactly three quarters, a half and nothing of its value without the sheet.)",
      {}};
  const auto add = [&](const std::string& name, double gap, const AxisRectangle& covered, double share) {
    theme.cases.push_back({name,
                           "Howell C-11, symmetry",
                           {facingUp(unitSquare), facingDown(unitSquare, gap), facingDown(covered, gap / 2)},
                           (1 - share) * tests::parallelRectangles(unitSquare, unitSquare, gap),
                           true});
  };
  add("a quarter", 1, {{-1, 0.5}, {-1, 0.5}}, 0.25);
  add("half", 1, {{-1, 0.5}, {-1, 2}}, 0.5);
  add("all", 1, {{-1, 2}, {-1, 2}}, 1);
  add("half, squares 0.05 sides apart", 0.05, {{-1, 0.5}, {-1, 2}}, 0.5);
  return theme;
}

FormFactorTheme coincident() {
  const Surface under = facingUp(unitSquare), over = facingDown(unitSquare, 1);
  const Surface turned = tests::parallelogram("turned", {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  const double c = tests::parallelRectangles(unitSquare, unitSquare, 1);
  // A floor that continues behind the wall, and a wall that continues below the floor: half of each is behind the
  // other. These halves see only backs and count as the inside of a solid. The rest are unit squares that share an
  // edge.
  const AxisRectangle both{{0, 1}, {-1, 1}};
  const std::string order = "the first in the file is seen";
  return {
      "Coincident and interpenetrating surfaces",
      R"(Of surfaces at the same distance, hemicubes and rays see the first in the file, even if it is a back: see the last of
the limits. Where two squares cross, the half behind the other square sees only a back. It counts as the inside of a
solid. The remaining halves are rectangles that share an edge.)",
      {{"two squares in one place: to the first in the file", "Howell C-11", {under, over, over}, c, true},
       {"to the second", order, {under, over, over}, 0, true, 2},
       {"two that are back to back: to the one that faces, first in the file",
        "Howell C-11",
        {under, over, turned},
        c,
        true},
       {"to the one that faces, second in the file", order, {under, turned, over}, 0, true, 2},
       {"rectangles of 1 x 2 that cross in their middles, at a right angle",
        "Howell C-14",
        {facingUp(both), facingAlongY(both)},
        tests::perpendicularRectangles(unitSquare, unitSquare),
        true}}};
}

FormFactorTheme scaledAndMoved() {
  FormFactorTheme theme{
      "Scaled and moved scenes",
      R"(Two unit squares 0.3 apart, shifted sideways. Positions have double precision and all computations are relative to the
centre of the scene. At 1e8 coordinates are multiples of 1.5e-8, which causes the error of that row.)",
      {}};
  const AxisRectangle from{{0.1, 1.1}, {0.2, 1.2}}, to{{0.4, 1.4}, {0, 1}};
  const double gap = 0.3;
  const auto add = [&](const std::string& name, double scale, double by) {
    FormFactorCase extreme = parallel(name, unequal, from, to, gap);
    for (Surface& surface : extreme.surfaces)
      for (radiosity::Triangle& triangle : surface.triangles)
        for (glm::dvec3& corner : triangle.position) corner = scale * corner + by;
    // Half a unit in the last place of each coordinate. Two of them define the gap; the logarithm of the form factor
    // depends on that of the gap by at most 1. Eight define the edges of the rectangles, with a dependence of about 1
    // as well.
    extreme.inputRounding = 10 * 0x1p-53 * (1 + by / scale) / gap;
    theme.cases.push_back(extreme);
  };
  add("as they are", 1, 0);
  for (const double scale : {1e-6, 1e6}) add("scaled by " + numberText(scale), scale, 0);
  for (const double by : {1e3, 1e6, 1e8}) add("moved by " + numberText(by), 1, by);
  return theme;
}

/// A square of 1e-8 of the scene's area, a quarter below the ceiling of a unit cube.
FormFactorTheme smallEmitters() {
  const double side = std::sqrt(6e-8);
  const AxisRectangle light{{0.4, 0.4 + side}, {0.3, 0.3 + side}};
  std::vector<Surface> fromLight = tests::box("room", {}, {1, 1, 1}, true), fromFloor = fromLight;
  fromLight.insert(fromLight.begin(), facingDown(light, 0.75));
  fromFloor.insert(fromFloor.begin() + 1, facingDown(light, 0.75));
  return {
      "Emitters of 1e-8 of the scene's area",
      R"(A square light hangs in a unit cube, a quarter below the ceiling. Solutions use the first row, because emitters shoot
first. There all 64 hemicubes lie almost at one point and have the same error. From the floor the light is smaller than
a pixel, and the hemicubes miss it.)",
      {{"from the emitter to the floor", unequal, fromLight, tests::parallelRectangles(light, unitSquare, 0.75)},
       {"from the floor to the emitter", unequal, fromFloor, tests::parallelRectangles(unitSquare, light, 0.75)}}};
}

}  // namespace hemitex::accuracy
