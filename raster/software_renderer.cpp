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

/// What the values change by from column to column.
EdgeValues stepOf(const ScreenTriangle& triangle) {
  EdgeValues step;
  for (std::size_t k = 0; k < 3; ++k) step[k] = static_cast<double>(triangle.edges[k].a);
  return step;
}

bool isCovered(const ScreenTriangle& triangle, const EdgeValues& edge) {
  for (std::size_t k = 0; k < 3; ++k)
    if (edge[k] < 0 || (edge[k] == 0 && !triangle.edges[k].inclusive)) return false;
  return true;
}

/// Offers the covered samples of a row to its fragments; `fragments` starts at column `firstColumn`. In a narrow
/// triangle all samples are tried, which takes no division.
void drawRow(const ScreenTriangle& triangle, int row, int firstColumn, Fragment* fragments) {
  constexpr int narrow = 8;
  const bool isNarrow = triangle.endColumn - triangle.firstColumn <= narrow;
  const Span span = isNarrow ? Span{triangle.firstColumn, triangle.endColumn} : coveredColumns(triangle, row);
  EdgeValues edge = edgeValues(triangle, span.first, row);
  const EdgeValues step = stepOf(triangle);
  for (int column = span.first; column < span.end; ++column) {
    if (!isNarrow || isCovered(triangle, edge))
      offer(fragments[column - firstColumn], triangle, inverseDepthAt(triangle, edge), column, row);
    for (std::size_t k = 0; k < 3; ++k) edge[k] += step[k];
  }
}

/// A texture coordinate along a row of a triangle: its values at the corners, each over w and the area.
struct CoordinateTerms {
  const Coordinate* coordinate;
  int size;  ///< texels along it
  std::array<double, 3> overDepth;
};

CoordinateTerms termsOf(const ScreenTriangle& triangle, const Coordinate& coordinate, int size) {
  CoordinateTerms terms{&coordinate, size, {}};
  for (std::size_t k = 0; k < 3; ++k) terms.overDepth[k] = coordinate.at[k] * triangle.inverseDepth[k];
  return terms;
}

/// clamp(floor(coordinate * size), 0, size - 1) at the sample of a fragment.
int texelAt(const Fragment& fragment, const EdgeValues& edge, const CoordinateTerms& terms, int column, int row) {
  const std::array<double, 3>& overDepth = terms.overDepth;
  const double sum = edge[0] * overDepth[0] + edge[1] * overDepth[1] + edge[2] * overDepth[2];
  const double position = sum / fragment.inverseDepth * terms.size;
  // The numerator is off by at most 6 roundoffs of largest / w, the denominator by 6 of 1/w, and two roundings follow.
  const double error = 16 * unitRoundoff * terms.coordinate->largest * terms.size;
  if (error < 0.25) {
    if (position < 1 - error) return 0;
    if (position > terms.size - 1 + error) return terms.size - 1;
    const int texel = static_cast<int>(position);
    const double fraction = position - texel;
    if (fraction > error && fraction < 1 - error) return texel;
  }
  return texelExactly(*fragment.triangle, terms.coordinate->at, terms.size, column, row);
}

/// Resolves fragments of one triangle that lie side by side, from a column on: back, plain offset, or offset and texel
/// blended.
void resolveRun(const DrawList& list, std::span<const Fragment> fragments, int firstColumn, int row, Word* words) {
  const auto fill = [&](Word word) { std::fill_n(words, fragments.size(), word); };
  if (fragments.front().triangle == nullptr) return fill(backgroundWord(list.format));
  const ScreenTriangle& triangle = *fragments.front().triangle;
  const Draw& draw = list.draws[triangle.draw];
  if (triangle.facesAway && draw.back) return fill(*draw.back);
  if (!draw.indexMap) return fill(draw.offset);
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const CoordinateTerms u = termsOf(triangle, triangle.u, map.width), v = termsOf(triangle, triangle.v, map.height);
  EdgeValues edge = edgeValues(triangle, firstColumn, row);
  const EdgeValues step = stepOf(triangle);
  int column = firstColumn;
  for (const Fragment& fragment : fragments) {
    const auto i = static_cast<std::size_t>(texelAt(fragment, edge, u, column, row));
    const auto j = static_cast<std::size_t>(texelAt(fragment, edge, v, column, row));
    *words++ = blend(list.format, list.blend, draw.offset, map.words[j * static_cast<std::size_t>(map.width) + i]);
    for (std::size_t k = 0; k < 3; ++k) edge[k] += step[k];
    ++column;
  }
}

/// Resolves the fragments of a row, run by run of one triangle.
void resolveRow(const DrawList& list, std::span<const Fragment> fragments, int firstColumn, int row, Word* words) {
  for (std::size_t first = 0, end = 0; first < fragments.size(); first = end) {
    while (end < fragments.size() && fragments[end].triangle == fragments[first].triangle) ++end;
    resolveRun(list, fragments.subspan(first, end - first), firstColumn + static_cast<int>(first), row, words + first);
  }
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
  for (int row = firstRow; row < endRow; ++row)
    resolveRow(list, std::span(fragments).subspan(static_cast<std::size_t>(row - firstRow) * width, width),
               scissor.column, row, buffer.words.data() + static_cast<std::size_t>(row - scissor.row) * width);
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
    used += triangleCount(cluster);
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
        dropped[i] += appendScreenTriangles(list_, faces[f], cluster.runs, skipped, triangles[f][c]);
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
