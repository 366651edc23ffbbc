/// A closed room with plants: thousands of triangles in leaves that touch nothing, each a surface of its own. It is a
/// scene without benefit from index maps. The camera stands outside and looks through the front wall.
#include <cmath>
#include <cstdint>

#include "data/generate/curves.h"
#include "data/generate/models.h"
#include "data/generate/seams.h"
#include "data/generate/shapes.h"
#include "data/generate/walls.h"

namespace hemitex::data {
namespace {

struct Plant {
  std::string name, material;
  glm::dvec3 foot{0.0};
  double potRadius = 0, potHeight = 0;
  double crownHeight = 0, crownRadius = 0;  ///< middle of the leaves above the foot, and their distance from it
  int leaves = 0;
  double leafLength = 0;
};

/// Pseudo-random fractions in [0, 1), always the same.
class Fractions {
 public:
  double next() { return (state_ = state_ * 1664525u + 1013904223u) / 4294967296.0; }

 private:
  std::uint32_t state_ = 1;
};

/// A leaf is a flat tetrahedron: its upper two faces meet in the line across it, the lower two in the midrib.
void addLeaf(std::vector<Group>& groups, const std::string& name, const std::string& material, const glm::dvec3& base,
             const glm::dvec3& along, const glm::dvec3& side, const glm::dvec3& up) {
  const auto rounded = [](const glm::dvec3& point) { return roundedPosition(point, 1e4); };
  const glm::dvec3 foot = rounded(base), tip = rounded(base + along);
  const glm::dvec3 left = rounded(base + 0.45 * along - side + up), right = rounded(base + 0.45 * along + side + up);
  const glm::dvec2 a{0, 0}, b{1, 0}, c{1, 1}, d{0, 1};
  groups.push_back({name, material, {{{foot, right, left}, {a, b, d}}, {{tip, left, right}, {c, d, b}}}});
  groups.push_back({name + "-under", material, {{{foot, tip, right}, {a, c, b}}, {{tip, foot, left}, {c, a, d}}}});
}

/// Leaves around a crown's middle, in steps of the golden angle, so that none is above another.
void addLeaves(std::vector<Group>& groups, const Plant& plant, Fractions& fractions) {
  // The cosine and the sine of the golden angle, pi (3 - sqrt(5)).
  const glm::dvec2 golden{-0.7373688780783197, 0.6754902942615238};
  glm::dvec2 turn{1, 0};
  for (int i = 0; i < plant.leaves; ++i) {
    turn = {golden.x * turn.x - golden.y * turn.y, golden.x * turn.y + golden.y * turn.x};
    const double y = 0.95 - 1.75 * (i + 0.5) / plant.leaves, level = std::sqrt(1 - y * y);
    const glm::dvec3 out{level * turn.x, y, -level * turn.y};
    const glm::dvec3 around{-turn.y, 0, -turn.x};
    const double distance = plant.crownRadius * (0.5 + 0.5 * fractions.next());
    const double length = plant.leafLength * (0.75 + 0.5 * fractions.next());
    const glm::dvec3 along =
        glm::normalize(out + glm::dvec3(0, -0.35 + 0.3 * fractions.next(), 0) + (fractions.next() - 0.5) * around);
    const glm::dvec3 side = glm::normalize(glm::cross(along, glm::normalize(out + glm::dvec3(0, 1.2, 0))));
    const glm::dvec3 up = glm::cross(side, along);
    const glm::dvec3 middle = plant.foot + glm::dvec3(0, plant.crownHeight, 0);
    addLeaf(groups, plant.name + "-leaf-" + std::to_string(i + 1), plant.material, middle + distance * out,
            length * along, 0.28 * length * side, 0.06 * length * up);
  }
}

/// The pot stands in a hole of the floor; the stem rises from a hole in the soil.
void addPot(std::vector<Group>& groups, const Plant& plant) {
  constexpr int corners = 16;
  const double radius = plant.potRadius, height = plant.potHeight, soil = height - 0.04, stem = 0.1 * radius;
  groups.push_back({plant.name + "-pot", "clay",
                    revolved({{0.75 * radius, 0},
                              {0.95 * radius, height - 0.06},
                              {radius, height - 0.06},
                              {radius, height},
                              {0.88 * radius, height},
                              {0.88 * radius, soil}},
                             corners, plant.foot)});
  const glm::dvec3 ground = plant.foot + glm::dvec3(0, soil, 0);
  groups.push_back(
      {plant.name + "-soil", "soil", ring(disc(ground, 0.88 * radius, corners), disc(ground, stem, corners / 2))});
  groups.push_back({plant.name + "-stem", "bark",
                    revolved({{stem, soil}, {0.6 * stem, plant.crownHeight}, {0, plant.crownHeight + 0.2}}, corners / 2,
                             plant.foot)});
}

}  // namespace

Model plant() {
  Model model;
  model.name = "plant";
  model.about = {
      "A closed room with three plants of 1000 leaves in all, each leaf two surfaces of two triangles, its upper and",
      "its lower side: many small surfaces that have nothing to do with each other. Lengths, in metres, are made up.",
      "Written by hemitex_data.",
  };
  model.aboutMaterials = {
      "The materials of the room with plants, made up. Kd is diffuse reflectance, Ke emitted radiosity, both linear",
      "sRGB. Written by hemitex_data.",
  };
  model.materials = {{"plain", {0.75, 0.74, 0.7}},      {"boards", {0.5, 0.34, 0.2}},
                     {"sky", {0.45, 0.6, 0.7}},         {"clay", {0.62, 0.3, 0.17}},
                     {"soil", {0.1, 0.07, 0.05}},       {"bark", {0.3, 0.2, 0.12}},
                     {"leaf", {0.16, 0.42, 0.1}},       {"leaf-pale", {0.4, 0.55, 0.22}},
                     {"leaf-dark", {0.08, 0.28, 0.12}}, {"light", glm::dvec3{0.5}, {20, 18.5, 16}}};

  const std::vector<Plant> plants{{"tree", "leaf", {-0.4, 0, -0.5}, 0.34, 0.45, 1.6, 0.75, 560, 0.17},
                                  {"bush", "leaf-pale", {1.2, 0, 0.5}, 0.26, 0.34, 0.85, 0.45, 260, 0.13},
                                  {"fern", "leaf-dark", {-1.35, 0, 0.9}, 0.22, 0.3, 0.65, 0.36, 180, 0.12}};
  const Polygon ceiling = rectangle(-2.2, 2.2, -2, 2, 2.9);
  const Polygon light = rectangle(-1.1, 1.1, -0.2, 0.9, 2.9);
  model.groups = walls(ceiling, {"plain", "sky", "plain", "plain"});
  model.groups.push_back({"ceiling", "plain", frame(reversed(ceiling), reversed(light))});
  model.groups.push_back({"light", "light", {reversed(light)}});
  Group floor{"floor", "boards", {}};
  std::vector<Rectangle> squares;
  for (const Plant& p : plants) {
    const double half = 0.85 * p.potRadius;
    squares.push_back({p.foot.x - half, p.foot.x + half, p.foot.z - half, p.foot.z + half});
    for (const Polygon& polygon : squareWithHole(p.foot, half, 0.75 * p.potRadius, 16))
      floor.polygons.push_back(polygon);
    addPot(model.groups, p);
  }
  for (const Rectangle& cell : cutOut({-2.2, 2.2, -2, 2}, squares))
    floor.polygons.push_back(rectangle(cell.left, cell.right, cell.bottom, cell.top, 0));
  model.groups.push_back(floor);
  closeSeams(model.groups, 1e4);
  Fractions fractions;
  for (const Plant& p : plants) addLeaves(model.groups, p, fractions);
  model.view = {{0, 1.5, 5.6}, {0, 1.45, 0}, {0, 1, 0}, 43};
  return model;
}

}  // namespace hemitex::data
