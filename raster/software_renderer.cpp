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

/// The values of the three edges at a sample. They are integers below 2^49, so binary64 holds them, and steps from
/// column to column, without rounding.
using EdgeValues = std::array<double, 3>;

EdgeValues edgeValues(const ScreenTriangle& triangle, int column, int row) {
  EdgeValues values;
  for (std::size_t k = 0; k < 3; ++k) values[k] = static_cast<double>(triangle.edges[k].at(column, row));
  return values;
}

/// 1/w at a sample. All terms are positive and each passes at most five roundings, so the relative error is below
/// 6 units of roundoff.
double inverseDepthAt(const ScreenTriangle& triangle, const EdgeValues& edge) {
  return edge[0] * triangle.inverseDepth[0] + edge[1] * triangle.inverseDepth[1] + edge[2] * triangle.inverseDepth[2];
}

/// The depth test: the larger 1/w wins, on an exact tie the earlier triangle keeps the pixel.
void offer(Fragment& fragment, const ScreenTriangle& triangle, double inverseDepth, int column, int row) {
  // Two values with relative errors below 6 roundoffs each are in order when they differ by 16.
  constexpr double margin = 16 * unitRoundoff;
  const double difference = inverseDepth - fragment.inverseDepth;
  const bool isClear = std::abs(difference) > margin * inverseDepth;
  if (isClear ? difference > 0 : isNearerExactly(triangle, *fragment.triangle, column, row))
    fragment = {inverseDepth, &triangle};
}

/// Offers the covered samples of a row to its fragments; `fragments` starts at column `firstColumn`.
void drawRow(const ScreenTriangle& triangle, int row, int firstColumn, Fragment* fragments) {
  const Span span = coveredColumns(triangle, row);
  EdgeValues edge = edgeValues(triangle, span.first, row);
  const EdgeValues step{static_cast<double>(triangle.edges[0].a), static_cast<double>(triangle.edges[1].a),
                        static_cast<double>(triangle.edges[2].a)};
  for (int column = span.first; column < span.end; ++column) {
    offer(fragments[column - firstColumn], triangle, inverseDepthAt(triangle, edge), column, row);
    for (std::size_t k = 0; k < 3; ++k) edge[k] += step[k];
  }
}

/// clamp(floor(coordinate * size), 0, size - 1) at the sample of a fragment.
int texelAt(const Fragment& fragment, const EdgeValues& edge, const Coordinate& coordinate, int size, int column,
            int row) {
  const std::array<double, 3>& inverseDepth = fragment.triangle->inverseDepth;
  const double sum = edge[0] * (coordinate.at[0] * inverseDepth[0]) + edge[1] * (coordinate.at[1] * inverseDepth[1]) +
                     edge[2] * (coordinate.at[2] * inverseDepth[2]);
  const double position = sum / fragment.inverseDepth * size;
  // The numerator is off by at most 6 roundoffs of largest / w, the denominator by 6 of 1/w, and two roundings follow.
  const double error = 16 * unitRoundoff * coordinate.largest * size;
  if (error < 0.25) {
    if (position < 1 - error) return 0;
    if (position > size - 1 + error) return size - 1;
    const int texel = static_cast<int>(position);
    const double fraction = position - texel;
    if (fraction > error && fraction < 1 - error) return texel;
  }
  return texelExactly(*fragment.triangle, coordinate.at, size, column, row);
}

/// The word of a fragment: back, plain offset, or offset and texel blended.
Word resolve(const DrawList& list, const Fragment& fragment, int column, int row) {
  if (fragment.triangle == nullptr) return backgroundWord(list.format);
  const ScreenTriangle& triangle = *fragment.triangle;
  const Draw& draw = list.draws[triangle.draw];
  if (triangle.facesAway && draw.back) return *draw.back;
  if (!draw.indexMap) return draw.offset;
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const EdgeValues edge = edgeValues(triangle, column, row);
  const auto i = static_cast<std::size_t>(texelAt(fragment, edge, triangle.u, map.width, column, row));
  const auto j = static_cast<std::size_t>(texelAt(fragment, edge, triangle.v, map.height, column, row));
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
  for (const std::vector<ScreenTriangle>& triangles : chunks)
    for (const ScreenTriangle& triangle : triangles)
      for (int row = std::max(firstRow, triangle.firstRow); row < std::min(endRow, triangle.endRow); ++row)
        drawRow(triangle, row, scissor.column, fragments.data() + static_cast<std::size_t>(row - firstRow) * width);
  const Fragment* fragment = fragments.data();
  Word* word = buffer.words.data() + static_cast<std::size_t>(firstRow - scissor.row) * width;
  for (int row = firstRow; row < endRow; ++row)
    for (int column = scissor.column; column < scissor.column + scissor.width; ++column)
      *word++ = resolve(list, *fragment++, column, row);
}

/// Consecutive clusters, gathered into chunks of about `size` triangles.
std::vector<std::vector<Cluster>> chunksOf(const std::vector<Cluster>& clusters, std::uint32_t size) {
  std::vector<std::vector<Cluster>> chunks;
  std::uint32_t used = size;
  for (const Cluster& cluster : clusters) {
    if (used >= size) {
      chunks.emplace_back();
      used = 0;
    }
    chunks.back().push_back(cluster);
    used += cluster.run.end - cluster.run.first;
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

SoftwareRenderer::SoftwareRenderer(DrawList list) : list_(std::move(list)) {
  validate(list_);
  chunks_ = chunksOf(clustersOf(list_), 4096);
}

std::vector<ItemBuffer> SoftwareRenderer::render(std::span<const Face> faces, std::span<const std::uint32_t> skipped) {
  for (const Face& face : faces) validate(face);

  std::vector<ScreenTriangles> triangles(faces.size(), ScreenTriangles(chunks_.size()));
  std::vector<std::uint64_t> dropped(faces.size() * chunks_.size());
  parallelFor(dropped.size(), [&](std::size_t i) {
    const std::size_t f = i / chunks_.size(), c = i % chunks_.size();
    for (const Cluster& cluster : chunks_[c])
      if (mayCover(faces[f], cluster))
        dropped[i] += appendScreenTriangles(list_, faces[f], cluster.run, skipped, triangles[f][c]);
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
