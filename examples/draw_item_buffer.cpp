/// Draws a triangle with an index map into an item buffer, and prints the element that each pixel shows.
#include <iomanip>
#include <iostream>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"
#include "raster/software/software_renderer.h"

using namespace hemitex::raster;

int main() {
  DrawList list;  // item IDs of four channels of 8 bits, added with a clamp
  list.positions = {{-1, -1, -2}, {1, -1, -2}, {0, 1, -2}};
  list.texcoords = {{0, 0}, {1, 0}, {0.5, 1}};
  list.indices = {0, 1, 2};
  list.indexMaps = {{2, 2, {0, 1, 2, 3}}};
  list.draws = {{.first = 0, .count = 3, .offset = 4, .back = {}, .indexMap = 0}};
  Face face;  // looks along -z
  face.resolution = 16;
  face.scissor = {0, 0, 16, 16};
  const ItemBuffer buffer = render(SoftwareRenderer(list), {&face, 1}).front();
  for (int row = 15; row >= 0; --row) {  // row 0 is at the bottom
    for (int column = 0; column < 16; ++column) {
      const ItemId id = buffer.ids[static_cast<std::size_t>(16 * row + column)];
      std::cout << (id == backgroundId(list.format) ? "." : std::to_string(id)) << ' ';
    }
    std::cout << '\n';
  }
}
