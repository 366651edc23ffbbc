/// One triangle, drawn with the rasterizer by projects that use hemitex.
#pragma once

#include "raster/software/software_renderer.h"

/// The item buffer, of 4 x 4 pixels.
inline hemitex::raster::ItemBuffer drawTriangle() {
  using namespace hemitex::raster;
  DrawList list;
  list.format = *formatNamed("r8g8b8");
  list.positions = {{-1, -1, 2}, {3, -1, 2}, {-1, 3, 2}};
  list.texcoords.resize(list.positions.size());
  list.indices = {0, 1, 2};
  list.draws = {{.first = 0, .count = 3, .offset = 7}};
  Face face;
  face.x = {1, 0, 0};
  face.y = {0, 1, 0};
  face.w = {0, 0, 1};
  face.nearDistance = 0.5F;
  face.resolution = 4;
  face.scissor = {0, 0, 4, 4};
  SoftwareRenderer renderer(list);
  return render(renderer, {&face, 1}, {}).front();
}

/// Whether the item IDs are right. The triangle's vertices lie at (-1/2, -1/2), (3/2, -1/2) and (-1/2, 3/2) of the
/// picture plane, so that it covers the pixel at (1/4, 1/4) and not the one at (-3/4, -3/4).
inline bool isRight(const hemitex::raster::ItemBuffer& buffer) {
  return buffer.ids[2 * 4 + 2] == 7 &&
         buffer.ids[0] == hemitex::raster::backgroundId(*hemitex::raster::formatNamed("r8g8b8"));
}
