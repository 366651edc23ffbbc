/// Clips triangles along the lines of a grid with unit cells: texels of a chart, or pixels of an image.
///
/// A triangle is cut into rows and each row into cells (Sutherland and Hodgman 1974, one line at a time). So the time
/// is proportional to the number of pieces, whatever the size of the grid. Each corner of a piece has barycentric
/// weights of the triangle. Weights give the share of its area, the point in space and the texture coordinate. They are
/// equally accurate for slivers, because all triangles have the same shape in them. Both sides of a cut get the same
/// new corners, so that no area is lost or counted twice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>

namespace hemitex::radiosity {

/// A corner of a piece of a triangle.
struct PieceCorner {
  glm::dvec2 grid;    ///< in cells
  glm::dvec2 weight;  ///< barycentric, of the triangle's corners 1 and 2
};

/// A convex polygon cut from a triangle, a quad, or a piece of at most eight corners. Each of the four sides of a cell
/// adds at most one corner.
struct Piece {
  std::array<PieceCorner, 12> corners;
  std::size_t size = 0;
};

/// The parts of a piece on both sides of a line.
struct Halves {
  Piece below, above;
};

/// Splits a piece along a line, given the signed distance of each corner from the line. Corners at distance 0 belong to
/// both parts.
Halves split(const Piece& piece, const std::array<double, 12>& distances);

/// The triangle as one piece; corners in cells.
Piece wholeTriangle(const std::array<glm::dvec2, 3>& grid);

/// Called with the column, the row, and the piece inside that cell.
using PieceVisitor = std::function<void(std::int64_t, std::int64_t, const Piece&)>;

/// Visits the pieces of a triangle, row by row. They cover the triangle without overlap: a piece on a line belongs to
/// one of the two cells. A piece that only touches its cell may be visited with a share of 0.
void forEachCell(const std::array<glm::dvec2, 3>& grid, const PieceVisitor& visit);
/// As above, for a convex polygon of three or four corners.
void forEachCellOf(const Piece& polygon, const PieceVisitor& visit);

/// The part of a triangle inside the closed cell [column, column + 1] x [row, row + 1]; may be empty.
Piece clippedToCell(const std::array<glm::dvec2, 3>& grid, std::int64_t column, std::int64_t row);
/// The part of a piece inside the rectangle [low, high] of the grid.
Piece clippedTo(const Piece& piece, const glm::dvec2& low, const glm::dvec2& high);

/// The area of the piece relative to that of the triangle, in [0, 1].
double share(const Piece& piece);

/// The barycentric weights (of corners 1 and 2) of the centroid of a piece, which must not be empty.
glm::dvec2 centroid(const Piece& piece);

/// The barycentric weights of a point in a closed triangle of either winding; nothing outside or if the triangle has no
/// area. A point on the common edge of two triangles is in at least one of them, whatever the rounding.
std::optional<glm::dvec2> weightsAt(const std::array<glm::dvec2, 3>& grid, const glm::dvec2& point);

}  // namespace hemitex::radiosity
