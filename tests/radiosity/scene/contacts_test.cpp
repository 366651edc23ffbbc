// Contacts and what is inside solids: the light of scenes whose faces touch and overlap, in any order and place.
// place.
#include "radiosity/scene/contacts.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <random>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/light/light.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/scene/surface_names.h"
#include "tests/support/box_text.h"
#include "tests/support/lattice_boxes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::BoxText, tests::LatticeBoxes, tests::latticeBoxes;

namespace {

/// Where a scene stands: its size, turned by an odd angle about an odd axis, and moved.
struct Standing {
  std::string name;
  double scale = 1;
  bool isTurned = false;
  double shift = 0;
};

const std::vector<Standing> places{
    {"as it is"}, {"turned", 1, true}, {"moved", 1, false, 1e4}, {"in mm", 1000}, {"turned in mm", 1000, true, 1e4}};

/// A rotation by the rational angle with cosine 15/17 about z, then by that with cosine 20/29 about x.
glm::dvec3 turned(const glm::dvec3& p) {
  const glm::dvec3 q((15 * p.x - 8 * p.y) / 17, (8 * p.x + 15 * p.y) / 17, p.z);
  return {q.x, (20 * q.y - 21 * q.z) / 29, (21 * q.y + 20 * q.z) / 29};
}

BoxText placed(BoxText text, const Standing& place) {
  for (BoxText::Part& part : text.parts)
    for (auto& quad : part.quads)
      for (glm::dvec3& corner : quad) corner = place.scale * (place.isTurned ? turned(corner) : corner) + place.shift;
  return text;
}

const std::string materials =
    "newmtl grey\nKd .5 .5 .5\nnewmtl light\nKd .8 .8 .8\nnewmtl dark\nKd .2 .2 .2\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n"
    "newmtl furnace\nKd .5 .5 .5\nKe .5 .5 .5\n";

/// What a solution says about a family of surfaces.
struct Lit {
  double area = 0, flux = 0;
  double farthest = 0;   ///< the largest distance of an element's radiosity from 1
  double brightest = 0;  ///< the largest radiosity of an element

  double mean() const { return area > 0 ? flux / area : 0; }
};

struct Solved {
  std::map<std::string, Lit> lit;
  double lostToBacks = 0;  ///< of the emitted flux
  std::vector<std::string> warnings;
};

/// Areas and fluxes are in units of the scene before it was placed.
Solved solved(const BoxText& text, const Standing& place = places[0], const glm::dvec3& sky = glm::dvec3(0),
              const SceneSettings& settings = {}) {
  Scene scene = placed(text, place).load(settings, materials);
  scene.outside.sky = sky;
  const Discretization discretization = discretize(scene, {.texelSize = 0.4 * place.scale});
  const Light light =
      radiosity::light(scene, discretization, {.drawing = {.resolution = 128}, .solver = {.residual = 1e-3}});
  Solved result;
  result.warnings = scene.warnings;
  const Energy& energy = light.solution.energy;
  result.lostToBacks = energy.lostToBacks[0] / energy.emitted[0];
  for (std::uint32_t e = 0; e < light.discretization.elements.size(); ++e) {
    const Element& element = light.discretization.elements[e];
    if (light.discretization.grids[element.surface].isDark) continue;
    Lit& of = result.lit[scene.surfaces[element.surface].family];
    const double area = element.area / (place.scale * place.scale), radiosity = light.solution.radiosity[e].x;
    of.area += area;
    of.flux += area * radiosity;
    of.farthest = std::max(of.farthest, std::abs(radiosity - 1));
    of.brightest = std::max(of.brightest, radiosity);
  }
  return result;
}

/// Calls check(order) for the orders of parts that start with each of them.
template <typename Check>
void forEachOrder(const BoxText& text, const Check& check) {
  BoxText order = text;
  for (std::size_t i = 0; i < text.parts.size(); ++i) {
    std::rotate(order.parts.begin(), order.parts.begin() + 1, order.parts.end());
    check(order);
  }
}

/// Calls check(order, place) for all orders as they are, and for all places with one order each.
template <typename Check>
void forEachOrderAndPlace(const BoxText& text, const Check& check) {
  forEachOrder(text, [&](const BoxText& order) { check(order, places[0]); });
  BoxText order = text;
  for (std::size_t i = 1; i < places.size(); ++i) {
    std::rotate(order.parts.begin(), order.parts.begin() + 1, order.parts.end());
    check(order, places[i]);
  }
}

bool hasWarning(const Solved& solved, const std::string& text) {
  return std::any_of(solved.warnings.begin(), solved.warnings.end(),
                     [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

BoxText zones(bool hasSecond) {
  BoxText text;
  text.begin("A");
  text.addBox({0, 0, 0}, {4, 3, 5}, true);
  text.begin("lamp", "lamp");
  text.addQuad({{{1.7, 2.9, 2.2}, {2.3, 2.9, 2.2}, {2.3, 2.9, 2.8}, {1.7, 2.9, 2.8}}});
  if (!hasSecond) return text;
  text.begin("B");
  text.addBox({4, 0.3, 0.7}, {8, 3.6, 4.1}, true);  // covers the wall of A in part, and reaches over it
  return text;
}

}  // namespace

TEST_CASE("Rooms that share a wall of two faces are lit as if alone", "[contacts]") {
  const double alone = solved(zones(false)).lit.at("A").flux;
  forEachOrderAndPlace(zones(true), [&](const BoxText& text, const Standing& place) {
    INFO(place.name << ", " << text.parts[0].name << " first");
    const Solved both = solved(text, place);
    CHECK(both.lit.at("A").flux == Approx(alone).epsilon(0.003));
    CHECK(both.lit.at("B").flux < 1e-4 * alone);
    CHECK(both.lostToBacks < 0.002);
  });
}

TEST_CASE("A sheet of two faces shows each side the face that looks there", "[contacts]") {
  BoxText text;
  text.begin("floor");
  text.addQuad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  text.begin("ceiling", "lamp");
  text.addQuad({{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}});
  text.begin("down");
  text.addQuad({{{0, 0, .5}, {0, 1, .5}, {1, 1, .5}, {1, 0, .5}}});
  text.begin("up");  // the other diagonal
  text.addQuad({{{1, 0, .5}, {1, 1, .5}, {0, 1, .5}, {0, 0, .5}}});
  for (const Standing& place : places)
    forEachOrder(text, [&](const BoxText& order) {
      INFO(place.name << ", " << order.parts[0].name << " first");
      const Solved sheet = solved(order, place);
      // Two equal squares, half of their side apart (Howell, C-11).
      CHECK(sheet.lit.at("up").mean() == Approx(0.5 * 9 * 0.415253).epsilon(0.01));
      CHECK(sheet.lit.at("floor").flux + sheet.lit.at("down").flux < 1e-6);
      CHECK(sheet.lostToBacks < 1e-6);
    });
}

TEST_CASE("A poster covers the wall that is listed before it, and no area counts twice", "[contacts]") {
  BoxText text;
  text.begin("lamp", "lamp");
  text.addQuad({{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}});
  text.begin("wall", "dark");
  text.addQuad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  text.begin("poster", "light");
  text.addQuad({{{.25, .25, 0}, {.75, .25, 0}, {.75, .75, 0}, {.25, .75, 0}}});
  for (const Standing& place : places) {
    INFO(place.name);
    const Solved poster = solved(text, place);
    CHECK(poster.lit.at("wall").area == Approx(0.75).epsilon(1e-6));
    CHECK(poster.lit.at("poster").area == Approx(0.25).epsilon(1e-6));
    // 9 times what a poster 1 mm before the wall gets.
    CHECK(poster.lit.at("poster").mean() == Approx(9 * 0.1836).epsilon(0.01));
    CHECK(hasWarning(poster, "`poster` covers `wall`"));
  }
  std::swap(text.parts[1], text.parts[2]);
  const Solved wall = solved(text);
  CHECK(wall.lit.count("poster") == 0);
  CHECK(wall.lit.at("wall").area == Approx(1).epsilon(1e-6));
  CHECK(hasWarning(wall, "`wall` covers `poster`"));
}

TEST_CASE("Solids in solids, and solids that are pushed through others, hide what is inside", "[contacts]") {
  const auto scene = [](const std::vector<std::pair<glm::dvec3, glm::dvec3>>& boxes) {
    BoxText text;
    text.begin("room", "furnace");
    text.addBox({-2, 0, -2}, {2, 3, 2}, true);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      text.begin("box" + std::to_string(i), "furnace");
      text.addBox(boxes[i].first, boxes[i].second, false);
    }
    return text;
  };
  const std::pair<glm::dvec3, glm::dvec3> outer{{-1.43, 0, -1.37}, {-0.41, 1, -0.44}};
  const BoxText nested = scene({outer, {{-1.2, 0, -1.2}, {-0.6, 0.2, -0.6}}});
  const BoxText through = scene({outer, {{-1.7, 0.4, -1.1}, {-0.1, 0.6, -0.7}}});
  const double footprint = 1.02 * 0.93;
  for (const BoxText* text : {&nested, &through})
    forEachOrderAndPlace(*text, [&](const BoxText& order, const Standing& place) {
      INFO(place.name << ", " << order.parts[0].name << " first, " << (text == &nested ? "nested" : "through"));
      const Solved furnace = solved(order, place);
      CHECK(furnace.lit.at("room").area == Approx(80 - footprint).epsilon(1e-6));
      CHECK(furnace.lostToBacks < 1e-4);
      for (const auto& [name, lit] : furnace.lit) {
        INFO(name);
        CHECK(lit.mean() == Approx(1).epsilon(0.01));
        CHECK(lit.farthest < 0.15);
      }
      if (text == &nested) CHECK(furnace.lit.count("box1") == 0);
    });
}

TEST_CASE("A room in a closed outer skin is lit as if alone, also where both skins coincide", "[contacts]") {
  for (const double thickness : {0.2, 0.0}) {
    BoxText text = zones(false);
    text.begin("box");
    text.addBox({1, 0, 1}, {2, 1, 2}, false);
    const double alone = solved(text).lit.at("A").flux;
    text.begin("skin");
    text.addBox(glm::dvec3(-thickness), glm::dvec3(4, 3, 5) + thickness, false);
    const auto check = [&](const BoxText& order, const Standing& place) {
      INFO(thickness << ' ' << place.name << ", " << order.parts[0].name << " first");
      const Solved room = solved(order, place);
      CHECK(room.lit.at("A").area == Approx(94 - 1).epsilon(1e-6));
      CHECK(room.lit.at("A").flux == Approx(alone).epsilon(0.003));
      CHECK(room.lostToBacks < 0.002);
    };
    forEachOrder(text, [&](const BoxText& order) { check(order, places[0]); });
    check(text, places.back());
  }
}

TEST_CASE("A fine mesh in a large scene keeps its faces", "[contacts]") {
  // The distance of contact is 1.3 mm, and quads are 2 mm wide.
  BoxText text;
  text.begin("ground");
  text.addQuad({{{-1000, 0, 1000}, {1000, 0, 1000}, {1000, 0, -1000}, {-1000, 0, -1000}}});
  text.begin("plate");
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const glm::dvec3 corner(0.002 * i, 1, 0.002 * j), x(0.002, 0, 0), z(0, 0, 0.002);
      text.addQuad({corner, corner + z, corner + x + z, corner + x});
    }
  const Scene scene = text.load();
  double plate = 0;
  for (const Surface& surface : scene.surfaces)
    if (surface.family == "plate") plate += area(surface);
  CHECK(plate == Approx(0.04 * 0.04).epsilon(1e-9));
  CHECK(scene.warnings.empty());
}

TEST_CASE("What stands on the back of a sheet gets no light from beyond it", "[contacts]") {
  BoxText text;
  text.begin("table");
  text.addQuad({{{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}});
  text.begin("box", "lamp");
  text.addBox({-.5, 0, -.5}, {.5, 1, .5}, false);
  for (const double sky : {0.0, 1.0}) CHECK(solved(text, places[0], glm::dvec3(sky)).lit.at("box").area == Approx(5));
}

TEST_CASE("A house that is turned over is named, and leaves the ground lit", "[contacts]") {
  for (const bool isInward : {true, false}) {
    BoxText text;
    text.begin("house");
    text.addBox({-1, 0, -1}, {1, 2, 1}, isInward);
    text.begin("ground");
    text.addQuad({{{-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}}});
    const Solved house = solved(text, places[0], glm::dvec3(1));
    CHECK(hasWarning(house, "all faces of `house` look inwards") == isInward);
    CHECK(house.lit.at("ground").area > 95.99);
    CHECK(house.lit.at("ground").mean() > 0.4);
    for (const auto& [name, lit] : house.lit) CHECK(lit.brightest < 1);  // the radiosity of the sky
  }
}

TEST_CASE("flip turns surfaces over by name, as if the file had them so", "[contacts]") {
  const auto house = [](bool isInward) {
    BoxText text;
    text.begin("house");
    text.addBox({-1, 0, -1}, {1, 2, 1}, isInward);
    text.begin("ground");
    text.addQuad({{{-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}}});
    return text;
  };
  const Scene flipped = house(true).load({.flip = {"house"}}), right = house(false).load();
  CHECK(flipped.warnings == right.warnings);
  REQUIRE(flipped.surfaces.size() == right.surfaces.size());
  for (std::size_t s = 0; s < right.surfaces.size(); ++s) {
    REQUIRE(flipped.surfaces[s].triangles.size() == right.surfaces[s].triangles.size());
    CHECK(area(flipped.surfaces[s]) == Approx(area(right.surfaces[s])).epsilon(1e-12));
    CHECK(normal(flipped.surfaces[s].triangles[0]) == normal(right.surfaces[s].triangles[0]));
  }
  CHECK_THROWS_WITH(house(true).load({.flip = {"hause"}}), Catch::Contains("hause") && Catch::Contains("house"));
}

TEST_CASE("A face of a solid that looks the other way is named, and changes nothing around it", "[contacts]") {
  BoxText text;
  text.begin("room");
  text.addBox({0, 0, 0}, {4, 3, 4}, true);
  text.begin("lamp", "lamp");
  text.addQuad({{{1, 2.9, 1}, {3, 2.9, 1}, {3, 2.9, 3}, {1, 2.9, 3}}});
  text.begin("box");
  text.addBox({1, 0, 1}, {2, 1, 2}, false);
  const double floor = solved(text).lit.at("room").area;
  std::swap(text.parts[2].quads[0][1], text.parts[2].quads[0][3]);
  const Solved turned = solved(text);
  CHECK(turned.lit.at("room").area == Approx(floor).epsilon(1e-9));
  CHECK(hasWarning(turned, "looks the other way than the other faces"));
}

namespace {

/// Moves the corners of a part by up to a distance, each corner of a quad by itself.
void jitter(BoxText::Part& part, double distance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> offset(-distance, distance);
  for (auto& quad : part.quads)
    for (glm::dvec3& corner : quad) corner += glm::dvec3(offset(random), offset(random), offset(random));
}

/// A floor, a lamp above it, and between them a roof of two slopes in two skins: one looks up, the other one down.
BoxText tent(double apart) {
  BoxText text;
  text.begin("floor");
  text.addQuad({{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}});
  text.begin("lamp", "lamp");
  text.addQuad({{{0, 2, 0}, {1, 2, 0}, {1, 2, 1}, {0, 2, 1}}});
  for (const bool isUpper : {true, false}) {
    text.begin(isUpper ? "upper" : "lower");
    for (const double foot : {0.0, 1.0}) {
      const double up = isUpper ? apart : 0;
      std::array<glm::dvec3, 4> slope{
          glm::dvec3(foot, 1 + up, 0), {foot, 1 + up, 1}, {.5, 1.5 + up, 1}, {.5, 1.5 + up, 0}};
      if ((foot == 0) != isUpper) std::reverse(slope.begin(), slope.end());
      text.addQuad(slope);
    }
  }
  return text;
}

}  // namespace

TEST_CASE("Two open skins whose corners differ by rounding are one sheet", "[contacts]") {
  const Solved apart = solved(tent(0.001));
  BoxText text = tent(1e-7);
  jitter(text.parts[2], 1e-7);
  jitter(text.parts[3], 1e-7);
  forEachOrder(text, [&](const BoxText& order) {
    const Solved touching = solved(order);
    CHECK(touching.lit.at("upper").flux == Approx(apart.lit.at("upper").flux).epsilon(0.01));
    CHECK(touching.lit.at("lower").flux < 1e-4);
    CHECK(touching.lostToBacks < 1e-4);
  });
}

TEST_CASE("A house of two open skins whose corners differ by rounding is lit as its room alone", "[contacts]") {
  BoxText text;
  text.begin("ground");
  text.addQuad({{{-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}}});
  text.begin("lamp", "lamp");
  text.addQuad({{{-.3, 1.8, -.3}, {.3, 1.8, -.3}, {.3, 1.8, .3}, {-.3, 1.8, .3}}});
  text.begin("room");
  text.addBox({-1, 0, -1}, {1, 2, 1}, true, 5);
  const Solved alone = solved(text);
  text.begin("skin");
  text.addBox({-1, 0, -1}, {1, 2, 1}, false, 5);
  jitter(text.parts[2], 2e-7);
  jitter(text.parts[3], 2e-7);
  forEachOrder(text, [&](const BoxText& order) {
    const Solved house = solved(order);
    CHECK(house.lit.at("room").flux == Approx(alone.lit.at("room").flux).epsilon(0.01));
    CHECK(house.lostToBacks < alone.lostToBacks + 0.001);
  });
}

TEST_CASE("Backs of two-sided surfaces are in contact as other faces are", "[contacts]") {
  BoxText text;
  text.begin("below", "lamp");
  text.addQuad({{{0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}}});
  text.begin("above", "lamp");
  text.addQuad({{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}});
  text.begin("wall", "dark");
  text.addQuad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  text.begin("poster", "light");
  text.addQuad({{{.25, .25, 0}, {.75, .25, 0}, {.75, .75, 0}, {.25, .75, 0}}});
  const auto radiosity = [&](const Solved& scene, const std::string& name) {
    return scene.lit.count(name) == 0 ? 0 : scene.lit.at(name).mean();
  };
  const Solved both = solved(text, places[0], glm::dvec3(0), {.sides = Sides::Two});
  CHECK(both.lit.at("wall").area == Approx(0.75));
  CHECK(both.lit.at("wall/back").area == Approx(1));  // the poster is behind the wall there
  CHECK(both.lit.count("poster/back") == 0);
  CHECK(radiosity(both, "wall/back") == Approx(9 * 0.2 * 0.199825).epsilon(0.01));
  CHECK(radiosity(both, "poster") == Approx(9 * 0.8 * 0.2295).epsilon(0.03));
  CHECK(both.lostToBacks == 0);
  // The second face of the sheet is in the file.
  text.parts.pop_back();
  text.begin("other", "light");
  text.addQuad({{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}});
  forEachOrder(text, [&](const BoxText& order) {
    for (const Sides sides : {Sides::Two, Sides::TwoOfSheets, Sides::One}) {
      const Solved sheet = solved(order, places[0], glm::dvec3(0), {.sides = sides});
      CHECK(radiosity(sheet, "wall") == Approx(9 * 0.2 * 0.199825).epsilon(0.01));
      CHECK(radiosity(sheet, "other") == Approx(9 * 0.8 * 0.199825).epsilon(0.01));
      CHECK(sheet.lit.count("wall/back") + sheet.lit.count("other/back") == 0);
    }
  });
}

TEST_CASE("Rooms that touch their images are lit as if alone", "[contacts]") {
  const double alone = solved(zones(false)).lit.at("A").flux;
  Symmetry repeated;
  repeated.period = {4, 0, 5};
  repeated.repeats = 1;
  const Solved rooms = solved(zones(false), places[0], glm::dvec3(0), {.symmetry = repeated});
  CHECK(rooms.lit.at("A").flux == Approx(alone).epsilon(0.003));
  CHECK(rooms.lostToBacks < 0.002);
}

TEST_CASE("A closed room of boxes side by side is dark under sky and sun", "[contacts]") {
  BoxText text;
  const auto add = [&](const std::string& name, const glm::dvec3& low, const glm::dvec3& high) {
    text.begin(name);
    text.addBox(low, high, false);
  };
  add("floor", {0, -.2, 0}, {4, 0, 5});
  add("ceiling", {0, 3, 0}, {4, 3.2, 5});
  add("left", {0, 0, 0}, {.2, 3, 5});
  add("right", {3.8, 0, 0}, {4, 3, 5});
  add("front", {.2, 0, 0}, {3.8, 3, .2});
  add("rear", {.2, 0, 4.8}, {3.8, 3, 5});
  // By 17 degrees.
  constexpr double cosine = 0.95630475596303544, sine = 0.29237170472273671;
  for (BoxText::Part& part : text.parts)
    for (auto& quad : part.quads)
      for (glm::dvec3& p : quad) p = {cosine * p.x + sine * p.z, p.y, -sine * p.x + cosine * p.z};
  Scene scene = text.load({}, materials);
  scene.outside.sky = glm::dvec3(1);
  scene.outside.suns = {{glm::normalize(glm::dvec3(1, 2, .3)), glm::dvec3(3)}};
  const Discretization discretization = discretize(scene, {.texelSize = 0.25});
  const Light light = radiosity::light(scene, discretization, {.drawing = {.resolution = 128}, .solver = {}});
  double brightest = 0, inside = 0;
  std::size_t count = 0;
  for (std::uint32_t e = 0; e < light.discretization.elements.size(); ++e) {
    const SurfacePoint point = elementCentre(scene, light.discretization, e);
    const glm::dvec3 p = point.position, at{cosine * p.x - sine * p.z, p.y, sine * p.x + cosine * p.z};
    const bool isInside = glm::all(glm::lessThan(glm::abs(at - glm::dvec3(2, 1.5, 2.5)), glm::dvec3(1.81, 1.51, 2.31)));
    if (isInside) ++count;
    double& largest = isInside ? inside : brightest;
    largest = std::max(largest, light.solution.radiosity[e].x);
  }
  CHECK(count > 500);
  CHECK(brightest > 1);
  CHECK(inside <= 1e-6 * brightest);
  CHECK(light.solution.energy.lostToBacks[0] < 1e-4 * light.solution.energy.emitted[0]);
}

TEST_CASE("Messages name a surface of which nothing can be seen, and the file of a wrong name", "[contacts]") {
  BoxText text;
  text.begin("poster", "light");
  text.addQuad({{{.25, .25, 0}, {.75, .25, 0}, {.75, .75, 0}, {.25, .75, 0}}});
  text.begin("wall", "dark");
  text.addQuad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  const Scene scene = text.load({}, materials);
  for (const bool isEdit : {true, false}) {
    const auto name = [&](const std::string& wanted) {
      if (!isEdit) return surfacesNamed(scene, wanted).size();
      return edited(scene, {}, std::vector<Edit>{SetEmission{wanted, glm::dvec3(1)}}).scene.surfaces.size();
    };
    CHECK_THROWS_WITH(name("poster"), Catch::Contains("nothing of `poster` can be seen"));
    CHECK_THROWS_WITH(name("postr"), Catch::Contains("is named `postr`"));
    CHECK(name("wall") == 1);
  }
  CHECK_THROWS_WITH(text.load({.flip = {"nobody"}}, materials),
                    Catch::Contains("scene.obj: no surface is named `nobody`"));
}

// The hard case: faces on a lattice, so that nearly all of them are in contact. `hemitex_lattice_furnace` in
// tests/benchmarks tries more of them.
TEST_CASE("Boxes on a lattice expose what no other box hides", "[contacts]") {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const LatticeBoxes boxes = latticeBoxes(seed);
    const Solved furnace = solved(boxes.text);
    INFO("seed " << seed << "\n" << boxes.listed);
    CHECK(furnace.lostToBacks < 1e-4);
    for (const auto& [name, area] : boxes.exposed) {
      INFO(name);
      const auto found = furnace.lit.find(name);
      CHECK((found == furnace.lit.end() ? 0 : found->second.area) == Approx(area).epsilon(0).margin(1e-4));
      if (found != furnace.lit.end() && area > 0) CHECK(found->second.mean() == Approx(1).epsilon(0.01));
    }
  }
}

TEST_CASE("Facets on a lattice are plain triangles of what no other box hides", "[contacts]") {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const LatticeBoxes boxes = latticeBoxes(seed);
    INFO("seed " << seed << "\n" << boxes.listed);
    const Scene scene = withoutBuried(boxes.text.load({.facets = true}, materials));
    std::map<std::string, double> areas;
    for (const Surface& surface : scene.surfaces)
      areas[surface.name.substr(0, surface.name.find('#'))] += area(surface);
    for (const auto& [name, area] : boxes.exposed) {
      INFO(name);
      CHECK(areas[name] == Approx(area).epsilon(0).margin(1e-4));
    }
    const Discretization elements = discretize(scene, {.texels = 1, .isUnburied = true});
    const IdLayout layout = layOut(elements, {});
    SceneFormFactors rows(scene, elements, layout, {.resolution = 64});
    double lost = 0, whole = 0;
    for (const Patch& patch : elements.patches.list) {
      lost += patch.area * formFactor(rows.row(patch).back);
      whole += patch.area;
    }
    CHECK(lost < 5e-4 * whole);
  }
}
