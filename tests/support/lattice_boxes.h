/// Random boxes in a room on a lattice, so that nearly all of their faces touch or overlap, and which area of each is
/// exposed: a count of unit squares, without geometry.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/support/box_text.h"

namespace hemitex::tests {

inline const std::string furnaceMaterial = "newmtl furnace\nKd .5 .5 .5\nKe .5 .5 .5\n";

struct LatticeBoxes {
  static constexpr int side = 8;  ///< of the room, in units
  BoxText text;                   ///< a room and solids, named `room`, `box0`, `box1`, ...; their radiosity is 1
  std::map<std::string, double> exposed = {};  ///< the area of each name
  std::string listed = {};                     ///< the corners of the boxes
};

inline LatticeBoxes latticeBoxes(unsigned seed) {
  constexpr int side = LatticeBoxes::side;
  using Box = std::array<glm::ivec3, 2>;
  std::mt19937 random(seed);
  const auto whole = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  std::vector<Box> boxes;
  for (int count = whole(2, 5); count > 0; --count) {
    glm::ivec3 low(0), size(0);
    for (const int axis : {0, 1, 2}) {
      low[axis] = whole(0, side - 2);
      size[axis] = whole(1, 4);
    }
    if (whole(0, 1) == 0) low.y = 0;
    boxes.push_back({low, glm::min(low + size, glm::ivec3(side))});
  }
  LatticeBoxes scene;
  scene.text.begin("room", "furnace");
  scene.text.addBox(glm::dvec3(0), glm::dvec3(side), true);
  scene.exposed["room"] = 0;
  const Box room{glm::ivec3(0), glm::ivec3(side)};
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const auto& [low, high] = boxes[b];
    scene.text.begin("box" + std::to_string(b), "furnace");
    scene.text.addBox(glm::dvec3(low), glm::dvec3(high), false);
    scene.exposed["box" + std::to_string(b)] = 0;
    for (const glm::ivec3& corner : boxes[b])
      for (const int axis : {0, 1, 2}) scene.listed += std::to_string(corner[axis]) + " ";
    scene.listed += "\n";
  }
  const auto isIn = [](const glm::ivec3& cell, const Box& box) {
    return glm::all(glm::greaterThanEqual(cell, box[0])) && glm::all(glm::lessThan(cell, box[1]));
  };
  // A face between two cells is exposed where the one before it is empty. The last box behind it shows its face.
  for (int axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1})
      for (int i = 0; i < side * side * side; ++i) {
        const glm::ivec3 cell(i % side, i / side % side, i / side / side);
        glm::ivec3 behind = cell;
        behind[axis] += step;
        if (std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return isIn(cell, box); })) continue;
        if (!isIn(behind, room)) scene.exposed["room"] += 1;
        for (std::size_t b = boxes.size(); b-- > 0;) {
          if (!isIn(behind, boxes[b])) continue;
          scene.exposed["box" + std::to_string(b)] += 1;
          break;
        }
      }
  return scene;
}

}  // namespace hemitex::tests
