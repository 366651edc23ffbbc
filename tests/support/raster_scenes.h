/// Small draw lists and faces for tests of the rasterizer, and functions that draw them. Random numbers are drawn in
/// the order of the text. They are drawn in braces, because the arguments of a call have no defined order.
#pragma once

#include "raster/culling/triangle_cluster.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/software/software_renderer.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::tests {

using reference::addDraw;
using reference::addTriangle;
using reference::countingMap;
using reference::frontFace;
using reference::plainList;
using reference::uniform;

/// Adds a triangle that covers one pixel of a front face (Picture).
inline void addPixel(raster::DrawList& list, int resolution, int column, int row, double w = 1) {
  reference::Picture picture(resolution);
  static_cast<raster::DrawList&>(picture) = std::move(list);
  picture.addPixel(column, row, w);
  list = std::move(picture);
}

inline raster::ItemBuffer drawOne(const raster::DrawList& list, const raster::Face& face,
                                  std::span<const std::uint32_t> skipped = {}) {
  return render(raster::SoftwareRenderer(list), {&face, 1}, skipped).front();
}

/// 2000 triangles that cross each other and the clip planes, as 40 textured surfaces with backs.
inline raster::DrawList crossingTriangles() {
  std::mt19937 random(9);
  raster::DrawList list;
  list.format = {{8, 8, 8, 8}};
  list.indexMaps.push_back(countingMap(16, 16));
  for (raster::ItemId surface = 0; surface < 40; ++surface) {
    addDraw(list, surface << 8, 0xfffffffe, 0);
    for (int t = 0; t < 50; ++t) {
      const auto point = [&] {
        return glm::vec3{uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -1, 4)};
      };
      const auto coordinate = [&] {
        const float v = uniform(random, 0, 1),
                    u = uniform(random, 0, 1);  // in this order, because their item IDs are pinned
        return glm::vec2(u, v);
      };
      const glm::vec3 a = point(), b = a + 0.3f * point(), c = a + 0.3f * point();
      const glm::vec2 ta = coordinate(), tb = coordinate(), tc = coordinate();
      addTriangle(list, {a, b, c}, {ta, tb, tc});
    }
  }
  return list;
}

/// Triangles of a few pixels in a front face of 64 x 64, 1 to 32 per draw; some draws have backs, some no index map. A
/// third of the triangles have corners on samples and halfway between them, and texture coordinates on texel borders,
/// which are binary fractions. So edges and borders pass through samples, where only rounding would decide. Another
/// third have a repeated corner or collinear corners. Triangles of one draw have different depths.
inline raster::DrawList smallTriangles(std::uint32_t draws) {
  std::mt19937 random(5);
  raster::DrawList list = plainList();
  list.indexMaps.push_back(countingMap(8, 4));
  const auto steps = [&random](unsigned most) { return static_cast<float>(random() % (most + 1)); };
  const auto between = [&random](float low, float high) { return uniform(random, low, high); };
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    addDraw(list, 100 * draw, draw % 3 == 0 ? std::optional(0xfffffffe) : std::nullopt,
            draw % 5 == 0 ? std::nullopt : std::optional(0));
    for (std::uint32_t t = 0; t <= draw % 32; ++t) {
      const bool isOnGrid = random() % 3 == 0, isFlat = random() % 3 == 0;
      const float x = steps(128) / 64 - 1, y = steps(128) / 64 - 1;
      std::array<glm::vec3, 3> p;
      std::array<glm::vec2, 3> texture;
      for (std::size_t k = 0; k < 3; ++k) {
        const float w = isOnGrid ? 1 + static_cast<float>((draw * 37 + t) % 1024) / 1024 : between(1, 3);
        const glm::vec2 at =
            isOnGrid ? glm::vec2{steps(8), steps(8)} / 64.0F : glm::vec2{between(0, 0.13F), between(0, 0.13F)};
        p[k] = {(x + at.x) * w, (y + at.y) * w, w};
        texture[k] = isOnGrid ? glm::vec2{steps(8) / 8, steps(4) / 4} : glm::vec2{between(0, 1), between(0, 1)};
      }
      if (isFlat) p[2] = random() % 2 == 0 ? p[0] : 0.5F * (p[0] + p[1]);
      addTriangle(list, {p[0], p[1], p[2]}, {texture[0], texture[1], texture[2]});
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

/// The screen triangles of a draw list in a face.
inline std::vector<raster::ScreenTriangle> screenTriangles(const raster::DrawList& list, const raster::Face& face) {
  std::vector<raster::ScreenTriangle> triangles;
  for (const raster::Cluster& cluster : raster::clustersOf(list))
    raster::appendScreenTriangles(list, face, cluster.runs, {}, triangles);
  return triangles;
}

/// threeFaces, and a face with a narrow range of its columns, so that rows end at all lanes of a vector.
inline std::vector<raster::Face> facesAndParts() {
  std::vector<raster::Face> faces;
  for (const raster::Face& face : threeFaces()) faces.push_back(face);
  for (int width = 1; width < 20; ++width) {
    faces.push_back(frontFace(64));
    faces.back().scissor = {21, 5, width, 40};
  }
  return faces;
}

/// Sorted by row and column, because kernels list pixels in any order.
inline std::vector<std::pair<int, int>> sorted(const raster::UnresolvedPixels& unresolved) {
  std::vector<std::pair<int, int>> pixels;
  for (const raster::Pixel& pixel : unresolved.pixels) pixels.emplace_back(pixel.row, pixel.column);
  std::sort(pixels.begin(), pixels.end());
  return pixels;
}

}  // namespace hemitex::tests
