/// The complex scene: a vaulted hall between a library and a picture gallery, with an apse and a domed round room.
///
/// All parts are built independently. Then closeSeams inserts the vertices of neighbours into each other's edges, so
/// that the rooms are closed to the last pixel. x points to the gallery's side and -z to the apse; lengths are in
/// metres and invented.
#include <algorithm>
#include <cstdint>

#include "data/generate/curves.h"
#include "data/generate/furniture.h"
#include "data/generate/gallery_plan.h"
#include "data/generate/models.h"
#include "data/generate/seams.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

/// The floor inside `area`, (x, z) from left to right and from back to front, without the holes for objects on it.
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

/// The closed rooms, with all parts that are cut into them.
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
  for (const std::string side : {"library", "gallery"}) addArcade(groups, side);
  addVault(groups);
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
  const std::vector<std::string> colours{"pompeian", "bottle", "cobalt", "ivory", "gilt", "walnut", "terracotta"};
  std::uint32_t state = 110;  // a value for which the model has 8088 triangles
  const auto next = [&](std::uint32_t below) { return (state = state * 1664525u + 1013904223u) / 65536u % below; };
  int shelf = 0;
  for (const Rectangle& niche : bookNiches()) {
    std::vector<Book> row;
    const double room = (niche.right - niche.left) * (0.45 + 0.05 * next(9));
    for (double used = 0; used < room;) {
      row.push_back({0.07 + 0.005 * next(12), 0.24 + 0.02 * next(9), colours[next(7)]});
      used += row.back().width;
      if (used > room) row.pop_back();
    }
    const double front = 0.04 + 0.01 * next(4);
    append(groups,
           placed(books(libraryWall(), niche, front, nicheDepth, row), "shelf-" + std::to_string(++shelf), {0, 0, 0}));
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
  // One of these is pulled out.
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
