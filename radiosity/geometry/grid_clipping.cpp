#include "radiosity/geometry/grid_clipping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "raster/base/cross.h"

namespace hemitex::radiosity {
namespace {

constexpr int columnAxis = 0;
constexpr int rowAxis = 1;

using raster::cross;

void append(Piece& piece, const PieceCorner& corner) {
  assert(piece.size < piece.corners.size());
  piece.corners[piece.size++] = corner;
}

/// The point where the edge from `a` to `b` crosses a line. It lies exactly on the line, and between the ends in the
/// other coordinate. So a convex polygon crosses each further line at most twice, whatever the rounding.
PieceCorner crossing(const PieceCorner& a, const PieceCorner& b, int axis, double line) {
  const double t = (line - a.grid[axis]) / (b.grid[axis] - a.grid[axis]);
  PieceCorner corner{a.grid + t * (b.grid - a.grid), a.weight + t * (b.weight - a.weight)};
  corner.grid = glm::clamp(corner.grid, glm::min(a.grid, b.grid), glm::max(a.grid, b.grid));
  corner.grid[axis] = line;
  return corner;
}

/// Splits a piece along a line of the grid; points on the line belong to both parts.
Halves split(const Piece& piece, int axis, double line) {
  Halves halves;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const PieceCorner& a = piece.corners[i];
    const PieceCorner& b = piece.corners[i + 1 < piece.size ? i + 1 : 0];
    const double fromLine = a.grid[axis] - line, nextFromLine = b.grid[axis] - line;
    if (fromLine <= 0) append(halves.below, a);
    if (fromLine >= 0) append(halves.above, a);
    if ((fromLine < 0 && nextFromLine > 0) || (fromLine > 0 && nextFromLine < 0)) {
      const PieceCorner corner = crossing(a, b, axis, line);
      append(halves.below, corner);
      append(halves.above, corner);
    }
  }
  return halves;
}

std::pair<double, double> rangeAlong(const Piece& piece, int axis) {
  double low = piece.corners[0].grid[axis], high = low;
  for (std::size_t i = 1; i < piece.size; ++i) {
    low = std::min(low, piece.corners[i].grid[axis]);
    high = std::max(high, piece.corners[i].grid[axis]);
  }
  return {low, high};
}

/// Calls visit(index, strip) for the parts of a piece between consecutive lines across `axis`, in ascending order.
template <typename Visit>
void forEachStrip(const Piece& piece, int axis, const Visit& visit) {
  const auto [low, high] = rangeAlong(piece, axis);
  Piece rest = piece;
  auto index = static_cast<std::int64_t>(std::floor(low));
  for (; high > static_cast<double>(index + 1); ++index) {
    const Halves halves = split(rest, axis, static_cast<double>(index + 1));
    visit(index, halves.below);
    rest = halves.above;
  }
  visit(index, rest);
}

/// Twice the signed area of (a, b, point). The two directions of an edge give exactly opposite values.
double edgeArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
  const bool isForward = std::pair(a.x, a.y) <= std::pair(b.x, b.y);
  return isForward ? cross(b - a, point - a) : -cross(a - b, point - b);
}

}  // namespace

Piece wholeTriangle(const std::array<glm::dvec2, 3>& grid) {
  Piece piece;
  append(piece, {grid[0], {0, 0}});
  append(piece, {grid[1], {1, 0}});
  append(piece, {grid[2], {0, 1}});
  return piece;
}

void forEachCell(const std::array<glm::dvec2, 3>& grid, const PieceVisitor& visit) {
  forEachCellOf(wholeTriangle(grid), visit);
}

void forEachCellOf(const Piece& polygon, const PieceVisitor& visit) {
  forEachStrip(polygon, rowAxis, [&](std::int64_t row, const Piece& strip) {
    forEachStrip(strip, columnAxis, [&](std::int64_t column, const Piece& piece) { visit(column, row, piece); });
  });
}

Halves split(const Piece& piece, const std::array<double, 12>& distances) {
  Halves halves;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const std::size_t next = i + 1 < piece.size ? i + 1 : 0;
    const PieceCorner& a = piece.corners[i];
    const PieceCorner& b = piece.corners[next];
    if (distances[i] <= 0) append(halves.below, a);
    if (distances[i] >= 0) append(halves.above, a);
    if ((distances[i] < 0 && distances[next] > 0) || (distances[i] > 0 && distances[next] < 0)) {
      const double t = distances[i] / (distances[i] - distances[next]);
      const PieceCorner corner{a.grid + t * (b.grid - a.grid), a.weight + t * (b.weight - a.weight)};
      append(halves.below, corner);
      append(halves.above, corner);
    }
  }
  return halves;
}

Piece clippedTo(const Piece& piece, const glm::dvec2& low, const glm::dvec2& high) {
  Piece clipped = split(piece, columnAxis, low.x).above;
  clipped = split(clipped, columnAxis, high.x).below;
  clipped = split(clipped, rowAxis, low.y).above;
  return split(clipped, rowAxis, high.y).below;
}

Piece clippedToCell(const std::array<glm::dvec2, 3>& grid, std::int64_t column, std::int64_t row) {
  const glm::dvec2 low(static_cast<double>(column), static_cast<double>(row));
  return clippedTo(wholeTriangle(grid), low, low + 1.0);
}

// In the plane of the two weights the triangle is half the unit square, so that twice the area of a piece is its share.
double share(const Piece& piece) {
  double doubled = 0;
  for (std::size_t i = 2; i < piece.size; ++i)
    doubled +=
        cross(piece.corners[i - 1].weight - piece.corners[0].weight, piece.corners[i].weight - piece.corners[0].weight);
  return std::clamp(doubled, 0.0, 1.0);
}

glm::dvec2 centroid(const Piece& piece) {
  assert(piece.size > 0);
  const glm::dvec2 first = piece.corners[0].weight;
  double doubled = 0;
  glm::dvec2 moment(0), sum(0);
  for (std::size_t i = 1; i < piece.size; ++i) {
    const glm::dvec2 previous = piece.corners[i - 1].weight - first, current = piece.corners[i].weight - first;
    const double part = std::max(0.0, cross(previous, current));
    doubled += part;
    moment += part * (previous + current);
    sum += current;
  }
  return first + (doubled > 0 ? moment / (3 * doubled) : sum / static_cast<double>(piece.size));
}

std::optional<glm::dvec2> weightsAt(const std::array<glm::dvec2, 3>& grid, const glm::dvec2& point) {
  const double e0 = edgeArea(grid[1], grid[2], point);
  const double e1 = edgeArea(grid[2], grid[0], point);
  const double e2 = edgeArea(grid[0], grid[1], point);
  const double sum = (e0 + e1) + e2;
  const bool isInside = (sum > 0 && std::min({e0, e1, e2}) >= 0) || (sum < 0 && std::max({e0, e1, e2}) <= 0);
  if (!isInside) return std::nullopt;
  return glm::dvec2(e1, e2) / sum;
}

}  // namespace hemitex::radiosity
