/// Draws one triangle with the rasterizer of the hemitex inside this project; returns 0 if the item IDs are right.
#include "raster/software/software_renderer.h"

int main() {
  using namespace hemitex;
  raster::DrawList list;
  list.format = *raster::formatNamed("r8g8b8");
  list.positions = {{-1, -1, 2}, {3, -1, 2}, {-1, 3, 2}};
  list.texcoords.resize(list.positions.size());
  list.indices = {0, 1, 2};
  list.draws = {{.first = 0, .count = 3, .offset = 7}};
  raster::Face face;
  face.x = {1, 0, 0};
  face.y = {0, 1, 0};
  face.w = {0, 0, 1};
  face.nearDistance = 0.5F;
  face.resolution = 4;
  face.scissor = {0, 0, 4, 4};

  raster::SoftwareRenderer renderer(list);
  const raster::ItemBuffer buffer = render(renderer, {&face, 1}, {}).front();
  // The triangle covers the pixel at (1/4, 1/4) of the picture plane and not the one at (-3/4, -3/4).
  return buffer.ids[2 * 4 + 2] == 7 && buffer.ids[0] == raster::backgroundId(list.format) ? 0 : 1;
}
