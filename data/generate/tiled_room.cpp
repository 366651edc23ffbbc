#include "data/generate/tiled_room.h"

#include <cassert>
#include <string>

namespace hemitex::data {
namespace {

/// A side of the room. `right` x `up` points into the room; both have the length of a tile.
struct TiledSide {
  std::string name;
  glm::dvec3 corner, right, up;
  int columns = 0, rows = 0;
};

bool isLight(const TiledSide& side, int column, int row) {
  return side.name == "ceiling" && column % 10 == 2 && row % 10 == 2;
}

void addTiles(const TiledSide& side, Model& model) {
  const auto at = [&side](int column, int row) {
    return side.corner + double(column) * side.right + double(row) * side.up;
  };
  for (int row = 0; row < side.rows; ++row)
    for (int column = 0; column < side.columns; ++column)
      model.groups.push_back(
          {side.name + "-" + std::to_string(column) + "-" + std::to_string(row),
           isLight(side, column, row) ? "light" : "tile",
           {{{at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)}}}});
}

}  // namespace

Model tiledRoom(int tiles) {
  assert(tiles >= 2 && tiles <= maxTiles);
  Model model;
  model.name = "tiled-room-" + std::to_string(tiles);
  model.about = {
      "A closed room of tiles, each a surface, to measure how time and memory grow. Written by hemitex_data."};
  model.aboutMaterials = {
      "Kd is diffuse reflectance, Ke emitted radiosity, both linear sRGB. Written by hemitex_data."};
  model.materials = {{"tile", {0.6, 0.6, 0.55}}, {"light", {0.5, 0.5, 0.5}, {10, 9, 8}}};
  const int wide = 2 * tiles;
  const double width = wide, height = tiles;
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const TiledSide& side :
       {TiledSide{"floor", {0, 0, 0}, z, x, wide, wide}, TiledSide{"ceiling", {0, height, 0}, x, z, wide, wide},
        TiledSide{"wall-back", {0, 0, 0}, x, y, wide, tiles}, TiledSide{"wall-front", {0, 0, width}, y, x, tiles, wide},
        TiledSide{"wall-left", {0, 0, 0}, y, z, tiles, wide},
        TiledSide{"wall-right", {width, 0, 0}, z, y, wide, tiles}})
    addTiles(side, model);
  model.view = {{width / 16, height / 2, width / 16}, {width, height / 4, width}, y, 60};
  return model;
}

}  // namespace hemitex::data
