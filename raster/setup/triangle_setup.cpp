#include "raster/setup/triangle_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemitex::raster {
namespace {

constexpr std::int64_t subPixels = 256;         // per pixel side
constexpr std::int64_t sample = subPixels / 2;  // the sample of a pixel is its centre

/// The edge from p to q. `orientation` is the sign of the triangle's area, so that the value is positive inside.
inline Edge makeEdge(const SnappedPoint& p, const SnappedPoint& q, std::int64_t orientation) {
  const std::int64_t a = orientation * (p.y - q.y);
  const std::int64_t b = orientation * (q.x - p.x);
  const std::int64_t c = -(a * p.x + b * p.y) + (a + b) * sample;
  // The interior lies where the value grows: at larger columns for a left edge, at larger rows for a top edge.
  const bool isLeft = a > 0;
  const bool isTop = a == 0 && b > 0;
  return {a * subPixels, b * subPixels, c, isLeft || isTop};
}

/// Whether the bounds hold so few samples that testing all of them first is cheapest.
bool isSmall(const ScreenTriangle& triangle) {
  constexpr int few = 4;
  return (triangle.endColumn - triangle.firstColumn) * (triangle.endRow - triangle.firstRow) <= few;
}

bool coversAny(const ScreenTriangle& triangle) {
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column)
      if (covers(triangle, column, row)) return true;
  return false;
}

/// Whether the triangle lies completely beyond one side of the view. Dropping it before clipping changes no pixel.
bool isOutsideView(const std::array<ViewVertex, 3>& p, double nearDistance) {
  const auto all = [&p](const auto& isOutside) { return isOutside(p[0]) && isOutside(p[1]) && isOutside(p[2]); };
  return all([=](const ViewVertex& q) { return q.w < nearDistance; }) ||
         all([](const ViewVertex& q) { return q.x > 2 * std::abs(q.w); }) ||
         all([](const ViewVertex& q) { return -q.x > 2 * std::abs(q.w); }) ||
         all([](const ViewVertex& q) { return q.y > 2 * std::abs(q.w); }) ||
         all([](const ViewVertex& q) { return -q.y > 2 * std::abs(q.w); });
}

/// Clips and appends triangle t, unless a value is not finite (raster rules, 2) or its draw culls it.
void appendScreenTriangle(const DrawList& list, const Face& face, bool mirrored, std::uint32_t draw, std::uint32_t t,
                          std::vector<ScreenTriangle>& triangles) {
  const std::array<ViewVertex, 3> vertices = view(face, list, t);
  if (!areFinite(vertices) || isOutsideView(vertices, face.nearDistance)) return;
  const ClippedPolygon polygon = clip(vertices, face.nearDistance);
  for (std::size_t k = 2; k < polygon.count; ++k) {
    ScreenTriangle triangle;
    triangle.draw = draw;
    triangle.number = t;
    if (makeScreenTriangle(face, fanTriangle(polygon, k), mirrored, triangle) &&
        !isCulled(list.draws[draw], triangle.facesAway))
      triangles.push_back(triangle);
  }
}

}  // namespace

bool covers(const ScreenTriangle& triangle, int column, int row) {
  for (const Edge& edge : triangle.edges)
    if (edge.at(column, row) < edge.minCovered()) return false;
  return true;
}

bool makeScreenTriangle(const Face& face, const std::array<ViewVertex, 3>& vertices, bool mirrored,
                        ScreenTriangle& triangle) {
  const auto& [a, b, c] = vertices;
  return makeScreenTriangle(face.scissor,
                            {snap(a, face.resolution), snap(b, face.resolution), snap(c, face.resolution)}, vertices,
                            mirrored, triangle);
}

bool makeScreenTriangle(const Scissor& scissor, const std::array<SnappedPoint, 3>& s,
                        const std::array<ViewVertex, 3>& vertices, bool mirrored, ScreenTriangle& triangle) {
  const std::int64_t area = edgeFunction(s[0], s[1], s[2]);
  if (area == 0) return false;

  const PixelRange columns = samplesBetween(s[0].x, s[1].x, s[2].x, scissor.column, scissor.column + scissor.width);
  const PixelRange rows = samplesBetween(s[0].y, s[1].y, s[2].y, scissor.row, scissor.row + scissor.height);
  triangle.firstColumn = columns.first;
  triangle.endColumn = columns.end;
  triangle.firstRow = rows.first;
  triangle.endRow = rows.end;
  if (triangle.firstColumn >= triangle.endColumn || triangle.firstRow >= triangle.endRow) return false;
  const std::int64_t orientation = area > 0 ? 1 : -1;
  triangle.edges[0] = makeEdge(s[1], s[2], orientation);
  triangle.edges[1] = makeEdge(s[2], s[0], orientation);
  triangle.edges[2] = makeEdge(s[0], s[1], orientation);
  if (isSmall(triangle) && !coversAny(triangle)) return false;

  triangle.area = std::abs(area);
  // docs/item-buffers.md, "facing": front-facing if the area and the determinant differ in sign.
  triangle.facesAway = (area < 0) == mirrored;
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.w[k] = vertices[k].w;
    triangle.u[k] = vertices[k].u;
    triangle.v[k] = vertices[k].v;
    triangle.inverseDepth[k] = 1 / vertices[k].w / static_cast<double>(triangle.area);
  }
  return true;
}

void appendScreenTriangles(const DrawList& list, const Face& face, std::span<const TriangleRun> runs,
                           std::span<const std::uint32_t> skipped, std::vector<ScreenTriangle>& triangles) {
  const bool mirrored = determinant(face) < 0;
  auto skip = skipped.end();
  std::uint32_t reached = std::numeric_limits<std::uint32_t>::max();
  for (const TriangleRun& run : runs) {
    // Draws may list triangles in any order. Usually they ascend, and the next skipped triangle is near.
    if (run.first < reached) skip = std::lower_bound(skipped.begin(), skipped.end(), run.first);
    while (skip != skipped.end() && *skip < run.first) ++skip;
    reached = run.end;
    for (std::uint32_t t = run.first; t < run.end; ++t) {
      if (skip != skipped.end() && *skip == t) {
        ++skip;
        continue;
      }
      appendScreenTriangle(list, face, mirrored, run.draw, t, triangles);
    }
  }
}

}  // namespace hemitex::raster
