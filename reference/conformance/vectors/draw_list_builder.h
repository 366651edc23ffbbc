/// Builds draw lists and faces from pictures laid out in pixels, for test vectors and tests.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// A face at the origin that looks along +z with rows growing along +y: pixel (i, j) of a face of R pixels looks
/// through ((2i + 1)/R - 1, (2j + 1)/R - 1, 1). Its determinant is 1, so triangles of negative area in the picture,
/// where rows grow downwards, face it.
inline raster::Face frontFace(int resolution, float nearDistance = 0.01f) {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, nearDistance, resolution, {0, 0, resolution, resolution}};
}

/// The distance of grid points to which corners are snapped, in pixels.
inline constexpr double subPixel = 1.0 / 256;

/// A list of 32-bit item IDs without channels.
inline raster::DrawList plainList() {
  raster::DrawList list;
  list.format = {{32}};
  return list;
}

/// Triangles and the faces that show them.
struct Drawing {
  raster::DrawList list;
  std::vector<raster::Face> faces;
};

/// The index map whose texel (column, row) holds row * width + column.
inline raster::IndexMap countingMap(int width, int height) {
  raster::IndexMap map{width, height, {}};
  for (raster::ItemId id = 0; id < static_cast<raster::ItemId>(width * height); ++id) map.ids.push_back(id);
  return map;
}

/// Appends an empty draw.
inline void addDraw(raster::DrawList& list, raster::ItemId offset, std::optional<raster::ItemId> back = {},
                    std::optional<int> indexMap = {}) {
  list.draws.push_back({static_cast<std::uint32_t>(list.indices.size()), 0, offset, back, indexMap});
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

/// Adds the triangles (0, 2, 1) and (0, 3, 2) of a quad to the last draw. Its texture coordinates are `low` at corner 0
/// and `high` at corner 2. A front face sees a quad from its front whose corners wind like those of the unit square.
inline void addQuad(raster::DrawList& list, const std::array<glm::vec3, 4>& corners, const glm::vec2& low = {0, 0},
                    const glm::vec2& high = {1, 1}) {
  addTriangle(list, {corners[0], corners[2], corners[1]}, {low, high, {high.x, low.y}});
  addTriangle(list, {corners[0], corners[3], corners[2]}, {low, {low.x, high.y}, high});
}

/// Pixels [firstColumn, endColumn) x [firstRow, endRow).
struct Block {
  int firstColumn, firstRow, endColumn, endRow;
};

/// A draw list laid out in the pixels of a front face; of 32-bit item IDs without channels, unless changed.
struct Picture : raster::DrawList {
  int resolution;
  float nearDistance;

  explicit Picture(int side, float near = 0.5f) : DrawList(plainList()), resolution(side), nearDistance(near) {}

  /// The point at depth w that the face shows at (column, row): in pixels, whose samples lie at the halves.
  glm::vec3 point(const glm::dvec2& pixel, double w = 1) const {
    const auto across = [&](double position) { return static_cast<float>((2 * position / resolution - 1) * w); };
    return {across(pixel.x), across(pixel.y), static_cast<float>(w)};
  }

  Block whole() const { return {0, 0, resolution, resolution}; }

  /// Adds a quad to the last draw that fills a block and faces the eye.
  void addBlock(const Block& block, double w = 1, const glm::vec2& low = {0, 0}, const glm::vec2& high = {1, 1}) {
    const auto& [column, row, endColumn, endRow] = block;
    addQuad(*this,
            {point({column, row}, w), point({endColumn, row}, w), point({endColumn, endRow}, w),
             point({column, endRow}, w)},
            low, high);
  }

  /// Adds a triangle to the last draw that covers the sample of one pixel, and no other, with constant coordinates.
  void addPixel(int column, int row, double w = 1, const glm::vec2& texcoord = {0, 0}) {
    const auto corner = [&](double x, double y) { return point({column + x, row + y}, w); };
    addTriangle(*this, {corner(0.125, 0.125), corner(0.25, 0.875), corner(0.875, 0.5)}, {texcoord, texcoord, texcoord});
  }
};

/// The vector of a picture, which its face shows.
inline TestVector makeVector(std::string name, std::string catches, const Picture& picture) {
  return makeVector(std::move(name), std::move(catches), picture,
                    {frontFace(picture.resolution, picture.nearDistance)});
}

/// Calls add(corners, column, row) for the cells of a sheet, whose corners the cells share: point(column, row) is
/// called once for each, row by row. The corners of a cell wind like those of the unit square.
template <typename MakePoint, typename Add>
void forEachCell(int cells, const MakePoint& point, const Add& add) {
  std::vector<decltype(point(0, 0))> points;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) points.push_back(point(column, row));
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const auto upper = points.begin() + row * (cells + 1) + column, lower = upper + cells + 1;
      add(std::array{upper[0], upper[1], lower[1], lower[0]}, column, row);
    }
}

/// Adds a sheet as one draw whose triangles show the texels of an index map in turn.
template <typename MakePoint>
void addTexelSheet(raster::DrawList& list, int cells, const MakePoint& point) {
  list.indexMaps.push_back(countingMap(2 * cells, cells));
  addDraw(list, 0, {}, 0);
  forEachCell(cells, point, [&](const std::array<glm::vec3, 4>& p, int column, int row) {
    const auto middle = [&](int texel) { return (glm::vec2(texel, row) + 0.5f) / glm::vec2(2 * cells, cells); };
    const glm::vec2 upper = middle(2 * column), lower = middle(2 * column + 1);
    addTriangle(list, {p[0], p[2], p[1]}, {upper, upper, upper});
    addTriangle(list, {p[0], p[3], p[2]}, {lower, lower, lower});
  });
}

/// Reverses the winding of the last draw.
inline void turnLastDraw(raster::DrawList& list) {
  const raster::Draw& draw = list.draws.back();
  for (std::size_t i = draw.first; i < list.indices.size(); i += 3) std::swap(list.indices[i], list.indices[i + 1]);
}

/// A number in [low, high) from the upper 24 bits of the generator. It is the same on every machine; the distributions
/// of the standard library are not.
inline float uniform(std::mt19937& random, float low, float high) {
  return low + (high - low) * (static_cast<float>(random() >> 8) * 0x1p-24f);
}

}  // namespace hemitex::reference
