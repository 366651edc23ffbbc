#include "raster/software_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "raster/exact.h"
#include "raster/parallel.h"
#include "raster/screen_triangle.h"

namespace hemitex::raster {
namespace {

constexpr double unitRoundoff = 0x1p-53;

/// What a pixel shows so far; no triangle where the background is.
struct Fragment {
  double inverseDepth = 0;
  const ScreenTriangle* triangle = nullptr;
};

/// 1/w at a sample. All terms are positive and each passes at most five roundings, so the relative error is below
/// 6 units of roundoff.
double inverseDepthAt(const ScreenTriangle& triangle, int column, int row) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += static_cast<double>(triangle.edges[k].at(column, row)) * triangle.inverseDepth[k];
  return sum;
}

/// The depth test: the larger 1/w wins, on an exact tie the earlier triangle keeps the pixel.
void offer(Fragment& fragment, const ScreenTriangle& triangle, int column, int row) {
  // Two values with relative errors below 6 roundoffs each are in order when they differ by 16.
  constexpr double margin = 16 * unitRoundoff;
  const double inverseDepth = inverseDepthAt(triangle, column, row);
  const double difference = inverseDepth - fragment.inverseDepth;
  const bool isClear = std::abs(difference) > margin * inverseDepth;
  if (fragment.triangle == nullptr ||
      (isClear ? difference > 0 : isNearerExactly(triangle, *fragment.triangle, column, row)))
    fragment = {inverseDepth, &triangle};
}

/// clamp(floor(coordinate * size), 0, size - 1) at the sample of a fragment.
int texelAt(const Fragment& fragment, const std::array<double, 3>& coordinate, int size, int column, int row) {
  const ScreenTriangle& triangle = *fragment.triangle;
  double sum = 0;
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    sum += static_cast<double>(triangle.edges[k].at(column, row)) * (coordinate[k] * triangle.inverseDepth[k]);
    largest = std::max(largest, std::abs(coordinate[k]));
  }
  const double position = sum / fragment.inverseDepth * size;
  // The numerator is off by at most 6 roundoffs of largest / w, the denominator by 6 of 1/w, and two roundings follow.
  const double error = 16 * unitRoundoff * largest * size;
  const bool isClear = std::abs(position - std::nearbyint(position)) > error;
  if (!isClear) return texelExactly(triangle, coordinate, size, column, row);
  return static_cast<int>(std::clamp(std::floor(position), 0.0, size - 1.0));
}

/// The word of a fragment: back, plain offset, or offset and texel blended.
Word resolve(const DrawList& list, const Fragment& fragment, int column, int row) {
  if (fragment.triangle == nullptr) return backgroundWord(list.format);
  const ScreenTriangle& triangle = *fragment.triangle;
  const Draw& draw = list.draws[triangle.draw];
  if (triangle.facesAway && draw.back) return *draw.back;
  if (!draw.indexMap) return draw.offset;
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const auto i = static_cast<std::size_t>(texelAt(fragment, triangle.u, map.width, column, row));
  const auto j = static_cast<std::size_t>(texelAt(fragment, triangle.v, map.height, column, row));
  return blend(list.format, list.blend, draw.offset, map.words[j * static_cast<std::size_t>(map.width) + i]);
}

/// The screen triangles of a face in draw order, in chunks that were made in parallel.
using ScreenTriangles = std::vector<std::vector<ScreenTriangle>>;

/// Rows [firstRow, endRow) of a face: depth first, then one word a pixel.
void drawRows(const DrawList& list, const ScreenTriangles& chunks, const Face& face, int firstRow, int endRow,
              ItemBuffer& buffer) {
  const Scissor& scissor = face.scissor;
  const auto width = static_cast<std::size_t>(scissor.width);
  std::vector<Fragment> fragments(static_cast<std::size_t>(endRow - firstRow) * width);
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row - firstRow) * width + static_cast<std::size_t>(column - scissor.column);
  };
  for (const std::vector<ScreenTriangle>& triangles : chunks)
    for (const ScreenTriangle& triangle : triangles)
      for (int row = std::max(firstRow, triangle.firstRow); row < std::min(endRow, triangle.endRow); ++row) {
        const Span span = coveredColumns(triangle, row);
        for (int column = span.first; column < span.end; ++column)
          offer(fragments[at(column, row)], triangle, column, row);
      }
  Word* word = buffer.words.data() + static_cast<std::size_t>(firstRow - scissor.row) * width;
  for (int row = firstRow; row < endRow; ++row)
    for (int column = scissor.column; column < scissor.column + scissor.width; ++column)
      *word++ = resolve(list, fragments[at(column, row)], column, row);
}

/// Consecutive runs that cover the draws in order, cut and gathered into chunks of about `size` triangles: what one
/// task turns into screen triangles.
std::vector<std::vector<TriangleRun>> chunksOf(const DrawList& list, std::uint32_t size) {
  std::vector<std::vector<TriangleRun>> chunks;
  std::uint32_t room = 0;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw) {
    std::uint32_t first = list.draws[draw].first / 3;
    const std::uint32_t end = first + list.draws[draw].count / 3;
    while (first < end) {
      if (room == 0) {
        chunks.emplace_back();
        room = size;
      }
      const std::uint32_t count = std::min(room, end - first);
      chunks.back().push_back({draw, first, first + count});
      first += count;
      room -= count;
    }
  }
  return chunks;
}

/// A range of rows of one face: what one task draws.
struct Band {
  std::size_t face;
  int firstRow, endRow;
};

std::vector<Band> bandsOf(std::span<const Face> faces) {
  std::vector<Band> bands;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Scissor& scissor = faces[f].scissor;
    const int height = std::max(1, faces[f].resolution / 4);
    for (int row = scissor.row; row < scissor.row + scissor.height; row += height)
      bands.push_back({f, row, std::min(row + height, scissor.row + scissor.height)});
  }
  return bands;
}

}  // namespace

SoftwareRenderer::SoftwareRenderer(DrawList list) : list_(std::move(list)) { validate(list_); }

std::vector<ItemBuffer> SoftwareRenderer::render(std::span<const Face> faces, std::span<const std::uint32_t> skipped) {
  for (const Face& face : faces) validate(face);

  const std::vector<std::vector<TriangleRun>> chunks = chunksOf(list_, 4096);
  std::vector<ScreenTriangles> triangles(faces.size(), ScreenTriangles(chunks.size()));
  std::vector<std::uint64_t> dropped(faces.size() * chunks.size());
  parallelFor(dropped.size(), [&](std::size_t i) {
    const std::size_t f = i / chunks.size(), c = i % chunks.size();
    for (const TriangleRun& run : chunks[c])
      dropped[i] += appendScreenTriangles(list_, faces[f], run, skipped, triangles[f][c]);
  });
  for (const std::uint64_t count : dropped) dropped_ += count;

  std::vector<ItemBuffer> buffers(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Scissor& scissor = faces[f].scissor;
    buffers[f] = {scissor.width, scissor.height, {}};
    buffers[f].words.resize(static_cast<std::size_t>(scissor.width) * static_cast<std::size_t>(scissor.height));
  }
  const std::vector<Band> bands = bandsOf(faces);
  parallelFor(bands.size(), [&](std::size_t i) {
    const Band& band = bands[i];
    drawRows(list_, triangles[band.face], faces[band.face], band.firstRow, band.endRow, buffers[band.face]);
  });
  return buffers;
}

}  // namespace hemitex::raster
