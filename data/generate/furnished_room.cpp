/// A closed room with furniture made of boxes that stand, hang and touch each other. Some boxes have no face where they
/// stand on something. The camera stands outside and looks through the front wall, whose back pictures leave out.
#include "data/generate/boxes.h"
#include "data/generate/models.h"
#include "data/generate/seams.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

void append(std::vector<Group>& groups, const std::vector<Group>& more) {
  groups.insert(groups.end(), more.begin(), more.end());
}

std::vector<Group> shell() {
  const Polygon ceiling = rectangle(-2, 2, -2.5, 2.5, 2.6);
  std::vector<Group> groups = walls(ceiling, {"plaster", "ochre", "plaster", "sage"});
  groups.push_back({"floor", "boards", {atHeight(ceiling, 0)}});
  groups.push_back({"ceiling", "white", {reversed(ceiling)}});
  return groups;
}

/// A slab in three groups: its two large faces, with names, and the four narrow faces between them.
std::vector<Group> slab(const std::string& name, const std::string& material, const Box& box, Side first, Side second) {
  return {faceGroup(name, material, box, first),
          faceGroup(name, material, box, second),
          {name + "-edges", material, charted(faces(box, {first, second}))}};
}

/// On the rug: two legs are closed, two have only sides.
std::vector<Group> table() {
  const Box top{{-0.4, 0.71, -0.35}, {1.2, 0.74, 0.55}};
  std::vector<Group> groups = slab("table-top", "oak", top, Side::Top, Side::Bottom);
  int number = 0;
  for (const double x : {-0.35, 1.09})
    for (const double z : {-0.3, 0.44}) {
      const std::vector<Side> without = ++number > 2 ? std::vector{Side::Top, Side::Bottom} : std::vector<Side>{};
      groups.push_back(
          boxGroup("table-leg-" + std::to_string(number), "oak", {{x, 0.01, z}, {x + 0.06, 0.71, z + 0.06}}, without));
    }
  append(groups, faceGroups("casket", "red", {{-0.2, 0.74, -0.15}, {0.1, 0.92, 0.1}}, {Side::Bottom}));
  groups.push_back(boxGroup("atlas", "blue", {{0.4, 0.74, 0.05}, {0.85, 0.78, 0.38}}));
  return groups;
}

/// Books from `left` on, side by side, each touching the next.
struct Book {
  double width, height, depth;
  const char* material;
  bool hasBottom;
};

void addBooks(std::vector<Group>& groups, double left, double bottom, double back, const std::vector<Book>& row) {
  for (const Book& book : row) {
    const Box box{{left, bottom, back}, {left + book.width, bottom + book.height, back + book.depth}};
    const std::vector<Side> without = book.hasBottom ? std::vector<Side>{} : std::vector{Side::Bottom};
    groups.push_back(boxGroup("book-" + std::to_string(groups.size() + 1), book.material, box, without));
    left += book.width;
  }
}

std::vector<Group> books() {
  std::vector<Group> groups;
  addBooks(groups, -1.675, 0.075, -2.5,
           {{0.07, 0.36, 0.26, "red", true},
            {0.06, 0.33, 0.24, "blue", false},
            {0.08, 0.38, 0.28, "cream", true},
            {0.05, 0.3, 0.22, "green", false},
            {0.11, 0.35, 0.27, "black", true}});
  addBooks(groups, -1.5, 0.525, -2.46,
           {{0.04, 0.27, 0.19, "cream", false},
            {0.05, 0.31, 0.21, "red", true},
            {0.03, 0.24, 0.17, "green", true},
            {0.09, 0.33, 0.23, "blue", false},
            {0.045, 0.28, 0.2, "black", false},
            {0.06, 0.25, 0.18, "ochre", true}});
  addBooks(groups, -0.765, 0.975, -2.44,
           {{0.05, 0.26, 0.18, "green", true},
            {0.07, 0.34, 0.22, "ochre", false},
            {0.04, 0.29, 0.2, "blue", true},
            {0.08, 0.37, 0.21, "red", false}});
  return groups;
}

/// Against the back wall. Every other board is closed; the others have no faces where they touch the sides and the
/// wall.
std::vector<Group> shelf() {
  std::vector<Group> groups = slab("shelf-left", "pine", {{-1.7, 0, -2.5}, {-1.675, 2, -2.2}}, Side::Left, Side::Right);
  const Box right{{-0.525, 0, -2.5}, {-0.5, 2, -2.2}};
  append(groups, faceGroups("shelf-right", "pine", right, {Side::Back, Side::Bottom}));
  int number = 0;
  for (const double y : {0.05, 0.5, 0.95, 1.4, 1.975}) {
    const Box board{{-1.675, y, -2.5}, {-0.525, y + 0.025, -2.2}};
    const std::string name = "shelf-board-" + std::to_string(++number);
    append(groups, number % 2 == 1 ? slab(name, "pine", board, Side::Top, Side::Bottom)
                                   : faceGroups(name, "pine", board, {Side::Left, Side::Right, Side::Back}));
  }
  return groups;
}

/// A closed crate in the corner of two walls and one on it without bottom. A free-standing block is rotated by the
/// angle of the triangle 7, 24, 25.
std::vector<Group> crates() {
  std::vector<Group> groups = faceGroups("crate", "pine", {{1.3, 0, -2.5}, {2, 0.6, -1.8}});
  append(groups, faceGroups("upper-crate", "red", {{1.45, 0.6, -2.4}, {1.95, 1, -1.95}}, {Side::Bottom}));
  int number = 0;
  const Polygon top{{{-1.54, 0.45, 1.42}, {-1.06, 0.45, 1.28}, {-1.2, 0.45, 0.8}, {-1.68, 0.45, 0.94}}};
  groups.push_back({"stool-top", "blue", {top}});
  for (const Polygon& side : sides(top, 0))
    groups.push_back({"stool-side-" + std::to_string(++number), "blue", {side}});
  return groups;
}

/// A foot, a pole, a bar on it that holds the shade, and a bulb on the bar.
std::vector<Group> lamp() {
  const glm::dvec3 foot{0.6, 0, -1.9};
  const auto box = [&](const glm::dvec3& half, double bottom, double top) {
    return Box{foot + glm::dvec3(-half.x, bottom, -half.z), foot + glm::dvec3(half.x, top, half.z)};
  };
  const std::vector<Side> sidesOnly{Side::Top, Side::Bottom};
  const Box outside = box({0.17, 0, 0.17}, 1.38, 1.7), inside = box({0.16, 0, 0.16}, 1.38, 1.7);
  std::vector<Polygon> inner;
  for (const Polygon& side : faces(inside, sidesOnly)) inner.push_back(reversed(side));
  return {boxGroup("lamp-foot", "black", box({0.15, 0, 0.15}, 0, 0.03), {Side::Bottom}),
          boxGroup("lamp-pole", "brass", box({0.015, 0, 0.015}, 0.03, 1.45), sidesOnly),
          boxGroup("lamp-bar", "brass", box({0.16, 0, 0.02}, 1.45, 1.47)),
          boxGroup("lamp-bulb", "light-bulb", box({0.05, 0, 0.05}, 1.47, 1.57)),
          {"lamp-shade-outside", "cream", charted(faces(outside, sidesOnly))},
          {"lamp-shade-inside", "cream", charted(inner)},
          {"lamp-shade-rim", "cream", charted(frame(face(outside, Side::Top), face(inside, Side::Top)))},
          {"lamp-shade-lower-rim", "cream", charted(frame(face(outside, Side::Bottom), face(inside, Side::Bottom)))}};
}

/// Flat objects: the rug lies on the floor, the picture hangs on the wall, the light below the ceiling. The picture has
/// a back.
std::vector<Group> flatThings() {
  const Box rug{{-0.8, 0, -0.7}, {1.5, 0.01, 1}}, light{{-0.5, 2.56, -0.2}, {0.9, 2.6, 0.3}};
  std::vector<Group> groups{{"rug", "wool", {face(rug, Side::Top)}},
                            {"rug-edges", "wool", charted(faces(rug, {Side::Top, Side::Bottom}))},
                            {"ceiling-light", "light", {face(light, Side::Bottom)}},
                            {"ceiling-light-edges", "white", charted(faces(light, {Side::Top, Side::Bottom}))}};
  append(groups, slab("picture", "blue", {{-2, 1.2, -0.6}, {-1.97, 1.9, 0.4}}, Side::Right, Side::Left));
  return groups;
}

}  // namespace

Model furnishedRoom() {
  Model model;
  model.name = "furnished-room";
  model.about = {
      "A closed room with a table, a shelf of books, crates, a lamp, a rug and a picture, all of boxes that stand on",
      "and touch each other, without gaps. Some boxes have no face where they stand on another, some do.",
      "Boxes of one surface have a chart of cells, one per face. Lengths, in metres, are made up.",
      "Written by hemitex_data.",
  };
  model.aboutMaterials = {
      "The materials of the furnished room, made up. Kd is diffuse reflectance, Ke emitted radiosity, both linear",
      "sRGB. Written by hemitex_data.",
  };
  model.materials = {{"plaster", {0.72, 0.7, 0.66}},
                     {"white", {0.85, 0.85, 0.84}},
                     {"sage", {0.35, 0.52, 0.36}},
                     {"ochre", {0.7, 0.48, 0.18}},
                     {"boards", {0.42, 0.3, 0.2}},
                     {"oak", {0.5, 0.36, 0.22}},
                     {"pine", {0.66, 0.52, 0.36}},
                     {"wool", {0.52, 0.16, 0.14}},
                     {"red", {0.6, 0.12, 0.1}},
                     {"blue", {0.12, 0.24, 0.56}},
                     {"green", {0.14, 0.42, 0.2}},
                     {"cream", {0.8, 0.74, 0.6}},
                     {"black", {0.1, 0.1, 0.11}},
                     {"brass", {0.55, 0.45, 0.22}},
                     {"light", glm::dvec3{0.5}, {20, 19, 17}},
                     {"light-bulb", glm::dvec3{0.5}, {60, 48, 30}}};
  model.groups = shell();
  for (const std::vector<Group>& piece : {table(), shelf(), books(), crates(), lamp(), flatThings()})
    append(model.groups, piece);
  for (Group& group : model.groups)
    for (Polygon& polygon : group.polygons)
      for (glm::dvec3& corner : polygon.corners) corner = roundedPosition(corner, 1e4);
  model.view = {{0.1, 1.6, 6.2}, {0, 1.15, 0}, {0, 1, 0}, 38};
  return model;
}

}  // namespace hemitex::data
