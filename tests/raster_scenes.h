/// Small draw lists and faces for the tests of the rasterizer.
#pragma once

#include <initializer_list>
#include <random>

#include "raster/software_renderer.h"

namespace hemitex::tests {

/// A face at the origin that looks along +z with rows growing along +y: pixel (i, j) of a face of R pixels looks
/// through ((2i + 1)/R - 1, (2j + 1)/R - 1, 1). Its determinant is 1, so clockwise triangles (in row order) face it.
inline raster::Face frontFace(int resolution) {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.01f, resolution, {0, 0, resolution, resolution}};
}

/// Adds a triangle to the list's last draw.
inline void addTriangle(raster::DrawList& list, std::initializer_list<glm::vec3> corners,
                        std::initializer_list<glm::vec2> texcoords = {{0, 0}, {0, 0}, {0, 0}}) {
  for (const glm::vec3& corner : corners) {
    list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
    list.positions.push_back(corner);
  }
  list.texcoords.insert(list.texcoords.end(), texcoords);
  list.draws.back().count += 3;
}

/// Starts a draw behind the others.
inline void addDraw(raster::DrawList& list, raster::Word offset, std::optional<raster::Word> back = {},
                    std::optional<int> indexMap = {}) {
  list.draws.push_back({static_cast<std::uint32_t>(list.indices.size()), 0, offset, back, indexMap});
}

/// A list of 32-bit words without channels.
inline raster::DrawList plainList() {
  raster::DrawList list;
  list.format = {{32}};
  return list;
}

/// The index map whose texel (column, row) holds row * width + column.
inline raster::IndexMap countingMap(int width, int height) {
  raster::IndexMap map{width, height, {}};
  for (raster::Word word = 0; word < static_cast<raster::Word>(width * height); ++word) map.words.push_back(word);
  return map;
}

inline raster::ItemBuffer drawOne(const raster::DrawList& list, const raster::Face& face,
                                  std::span<const std::uint32_t> skipped = {}) {
  return raster::SoftwareRenderer(list).render({&face, 1}, skipped).front();
}

/// A number in [low, high) from the upper 24 bits of the generator: the same on every machine, unlike the library's
/// distributions.
inline float uniform(std::mt19937& random, float low, float high) {
  return low + (high - low) * (static_cast<float>(random() >> 8) * 0x1p-24f);
}

}  // namespace hemitex::tests
