/// Small draw lists and faces for the tests of the rasterizer, and drawing them.
#pragma once

#include "raster/software_renderer.h"
#include "reference/simple_draws.h"

namespace hemitex::tests {

using reference::addDraw;
using reference::addPixel;
using reference::addTriangle;
using reference::countingMap;
using reference::frontFace;
using reference::plainList;
using reference::uniform;

inline raster::ItemBuffer drawOne(const raster::DrawList& list, const raster::Face& face,
                                  std::span<const std::uint32_t> skipped = {}) {
  return raster::SoftwareRenderer(list).render({&face, 1}, skipped).front();
}

/// 2000 triangles that cross each other and what clips them, as 40 textured surfaces with backs.
inline raster::DrawList crossingTriangles() {
  std::mt19937 random(9);
  raster::DrawList list;
  list.format = {{8, 8, 8, 8}};
  list.indexMaps.push_back(countingMap(16, 16));
  for (raster::Word surface = 0; surface < 40; ++surface) {
    addDraw(list, surface << 8, 0xfffffffe, 0);
    for (int t = 0; t < 50; ++t) {
      const auto point = [&] {
        return glm::vec3{uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -1, 4)};
      };
      const auto coordinate = [&] { return glm::vec2(uniform(random, 0, 1), uniform(random, 0, 1)); };
      const glm::vec3 a = point(), b = a + 0.3f * point(), c = a + 0.3f * point();
      const glm::vec2 ta = coordinate(), tb = coordinate(), tc = coordinate();
      addTriangle(list, {a, b, c}, {ta, tb, tc});
    }
  }
  return list;
}

/// Faces that see them: the front, the upper half to the right, the front at half the resolution.
inline std::array<raster::Face, 3> threeFaces() {
  std::array<raster::Face, 3> faces{frontFace(128), frontFace(128), frontFace(64)};
  faces[1].w = {1, 0, 0};
  faces[1].x = {0, 0, 1};
  faces[1].scissor = {0, 64, 128, 64};
  return faces;
}

}  // namespace hemitex::tests
