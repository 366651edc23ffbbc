// resolveContacts and Solids: the light of scenes whose faces touch, overlap and coincide, in any order and place.
#include "radiosity/scene/contacts.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <random>
#include <sstream>

#include "radiosity/discretization/discretize.h"
#include "radiosity/light/light.h"
#include "tests/support/box_text.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::BoxText;

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
Solved solved(const BoxText& text, const Standing& place = places[0], const glm::dvec3& sky = glm::dvec3(0)) {
  Scene scene = placed(text, place).load({.sides = Sides::One}, materials);
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
  for (const Standing& place : places)
    forEachOrder(zones(true), [&](const BoxText& text) {
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
  for (const Standing& place : places)
    for (const BoxText* text : {&nested, &through})
      forEachOrder(*text, [&](const BoxText& order) {
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

// The hard case: faces on a lattice, so that nearly all of them are in contact.
TEST_CASE("Boxes on a lattice expose what no other box hides", "[contacts]") {
  constexpr int side = 8;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    std::mt19937 random(seed);
    const auto whole = [&](int low, int high) {
      return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    std::vector<std::array<glm::ivec3, 2>> boxes;
    for (int count = whole(2, 5); count > 0; --count) {
      glm::ivec3 low(0), size(0);
      for (const int axis : {0, 1, 2}) {
        low[axis] = whole(0, side - 2);
        size[axis] = whole(1, 4);
      }
      if (whole(0, 1) == 0) low.y = 0;
      boxes.push_back({low, glm::min(low + size, glm::ivec3(side))});
    }
    BoxText text;
    text.begin("room", "furnace");
    text.addBox(glm::dvec3(0), glm::dvec3(side), true);
    std::map<std::string, double> expected{{"room", 0}};
    const auto isIn = [](const glm::ivec3& cell, const std::array<glm::ivec3, 2>& box) {
      return glm::all(glm::greaterThanEqual(cell, box[0])) && glm::all(glm::lessThan(cell, box[1]));
    };
    const auto isInAny = [&](const glm::ivec3& cell) {
      return std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) { return isIn(cell, box); });
    };
    const std::array<glm::ivec3, 2> room{glm::ivec3(0), glm::ivec3(side)};
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      text.begin("box" + std::to_string(b), "furnace");
      text.addBox(glm::dvec3(boxes[b][0]), glm::dvec3(boxes[b][1]), false);
    }
    // A face between two cells is exposed where the one before it is empty. The last box behind it shows its face.
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1})
        for (int i = 0; i < side * side * side; ++i) {
          const glm::ivec3 cell(i % side, i / side % side, i / side / side);
          glm::ivec3 behind = cell;
          behind[axis] += step;
          if (isInAny(cell)) continue;
          if (!isIn(behind, room)) expected["room"] += 1;
          for (std::size_t b = boxes.size(); b-- > 0;) {
            if (!isIn(behind, boxes[b])) continue;
            expected["box" + std::to_string(b)] += 1;
            break;
          }
        }
    const Solved furnace = solved(text);
    std::ostringstream listed;
    for (const auto& [low, high] : boxes)
      listed << "\n" << low.x << ' ' << low.y << ' ' << low.z << " to " << high.x << ' ' << high.y << ' ' << high.z;
    INFO("seed " << seed << listed.str());
    CHECK(furnace.lostToBacks < 1e-4);
    for (const auto& [name, area] : expected) {
      INFO(name);
      const auto found = furnace.lit.find(name);
      CHECK((found == furnace.lit.end() ? 0 : found->second.area) == Approx(area).epsilon(0).margin(1e-4));
      if (found != furnace.lit.end() && area > 0) CHECK(found->second.mean() == Approx(1).epsilon(0.01));
    }
  }
}
