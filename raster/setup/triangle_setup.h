/// Screen triangles: triangles after clipping and snapping to the sub-pixel grid (docs/item-buffers.md, "snap" to
/// "texel"). Coverage and barycentric weights are integers; depth and texture coordinates are rational functions of
/// them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/plain/rules.h"

namespace hemitex::raster {

/// The edge opposite a vertex, as the line a * column + b * row + c at pixel samples; positive inside. Its value
/// divided by the doubled area of the triangle is the barycentric weight of that vertex.
struct Edge {
  std::int64_t a, b, c;
  bool inclusive;  ///< a top or left edge: samples on it are covered

  std::int64_t at(int column, int row) const { return a * column + b * row + c; }
  /// The smallest value at covered samples, as values are integers.
  std::int64_t minCovered() const { return inclusive ? 0 : 1; }
};

struct ScreenTriangle {
  std::array<Edge, 3> edges;
  std::array<double, 3> w;     ///< at the vertices, above 0
  std::array<double, 3> u, v;  ///< at the vertices
  std::array<double, 3>
      inverseDepth;      ///< 1/w over the doubled area; the sum of edge value times this is 1/w at a sample
  std::int64_t area;     ///< doubled, in squared sub-pixels; above 0
  std::uint32_t draw;    ///< in DrawList::draws
  std::uint32_t number;  ///< in DrawList::indices / 3
  bool facesAway;        ///< clockwise as the eye sees it
  int firstRow, endRow;  ///< rows that may hold covered samples, inside the scissor rectangle
  int firstColumn, endColumn;
};

/// Whether the triangle covers the sample of a pixel.
bool covers(const ScreenTriangle& triangle, int column, int row);

/// Snaps three clipped vertices and sets all members of `triangle` except `draw` and `number`. Returns false if the
/// triangle covers no sample of the scissor rectangle. `mirrored` means that determinant(face) is negative.
bool makeScreenTriangle(const Face& face, const std::array<ViewVertex, 3>& vertices, bool mirrored,
                        ScreenTriangle& triangle);

/// As above, for vertices that are already snapped; uses only w, u and v of `vertices`.
bool makeScreenTriangle(const Scissor& scissor, const std::array<SnappedPoint, 3>& snapped,
                        const std::array<ViewVertex, 3>& vertices, bool mirrored, ScreenTriangle& triangle);

/// A run of triangles of one draw, by number in DrawList::indices / 3.
struct TriangleRun {
  std::uint32_t draw = 0;
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Appends the screen triangles of runs, in draw order, without triangles in `skipped` (ascending), without those that
/// have a value that is not finite, and without culled ones.
void appendScreenTriangles(const DrawList& list, const Face& face, std::span<const TriangleRun> runs,
                           std::span<const std::uint32_t> skipped, std::vector<ScreenTriangle>& triangles);

}  // namespace hemitex::raster
