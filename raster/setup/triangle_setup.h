/// Screen triangles: what is left of a triangle once it was clipped and snapped to the sub-pixel grid (raster rules,
/// 4 to 6). Coverage and barycentric weights are integers from here on; depth and texture coordinates are rational
/// functions of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/setup/vertex_stage.h"

namespace hemitex::raster {

/// The edge opposite a vertex, as the line a * column + b * row + c through the pixel samples: positive inside. Its
/// value over the triangle's doubled area is the barycentric weight of that vertex.
struct Edge {
  std::int64_t a, b, c;
  bool inclusive;  ///< a top or left edge: samples on it are covered

  std::int64_t at(int column, int row) const { return a * column + b * row + c; }
};

struct ScreenTriangle {
  std::array<Edge, 3> edges;
  std::array<double, 3> w;             ///< at the vertices, above 0
  std::array<double, 3> u, v;          ///< at the vertices
  std::array<double, 3> inverseDepth;  ///< 1 / w over the doubled area: 1/w at a sample is the sum of edge times this
  std::int64_t area;                   ///< doubled, in squared sub-pixels; above 0
  std::uint32_t draw;                  ///< in DrawList::draws
  std::uint32_t number;                ///< in DrawList::indices / 3
  bool facesAway;                      ///< winds clockwise as the eye sees it
  int firstRow, endRow;                ///< rows that may hold covered samples, inside the scissor rectangle
  int firstColumn, endColumn;
};

/// The sub-pixel position of q = x/w or y/w, 256 a pixel (raster rules, 4).
std::int64_t snap(double q, int resolution);

/// A sub-pixel position.
struct SnappedPoint {
  std::int64_t x, y;
};

/// Snaps three clipped vertices; false where no sample of the scissor rectangle can be covered. `mirrored` says that
/// determinant(face) is negative. All members of the triangle are set but `draw` and `number`.
bool makeScreenTriangle(const Face& face, const std::array<ViewVertex, 3>& vertices, bool mirrored,
                        ScreenTriangle& triangle);

/// The same for vertices that were snapped: only their w, u and v are looked at.
bool makeScreenTriangle(const Scissor& scissor, const std::array<SnappedPoint, 3>& snapped,
                        const std::array<ViewVertex, 3>& vertices, bool mirrored, ScreenTriangle& triangle);

/// A run of triangles of one draw, by number in DrawList::indices / 3.
struct TriangleRun {
  std::uint32_t draw = 0;
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Appends the screen triangles of runs, in draw order, without triangles in `skipped` (ascending) and without those
/// that have a value that is not finite.
void appendScreenTriangles(const DrawList& list, const Face& face, std::span<const TriangleRun> runs,
                           std::span<const std::uint32_t> skipped, std::vector<ScreenTriangle>& triangles);

}  // namespace hemitex::raster
