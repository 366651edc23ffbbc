#include "radiosity/discretization/exposed_pieces.h"

#include <algorithm>
#include <cmath>

#include "radiosity/geometry/box_tree.h"

namespace hemitex::radiosity {
namespace {

/// Visits the exposed parts of a piece of a triangle inside a cell.
void visitCell(std::uint32_t triangle, std::size_t texel, const Piece& piece, const TexelGrid& grid,
               const TexelPieceVisitor& visit) {
  const auto visitOpaque = [&](const Piece& exposed) {
    if (grid.mask == nullptr) return visit(texel, triangle, exposed);
    forEachOpaquePart(*grid.mask, glm::dvec2(grid.columns, grid.rows), exposed,
                      [&](const Piece& part) { visit(texel, triangle, part); });
  };
  const CutTexel* const cut = findCut(grid.cut, texel);
  if (cut == nullptr) return visitOpaque(piece);
  if (share(piece) == 0) return;  // a cell that the chart only touches maps to the next texel
  for (const TexelPiece& exposed : cut->exposed)
    if (exposed.triangle == triangle) visitOpaque(exposed.piece);
}

}  // namespace

bool hasCutTexel(const TexelGrid& grid, const glm::dvec2& low, const glm::dvec2& high) {
  if (grid.mask != nullptr && hasHole(*grid.mask, glm::dvec2(grid.columns, grid.rows), low, high)) return true;
  return std::any_of(grid.cut.begin(), grid.cut.end(), [&](const CutTexel& cut) {
    const double column = cut.texel % static_cast<std::uint32_t>(grid.columns);
    const double row = cut.texel / static_cast<std::uint32_t>(grid.columns);
    return column < high.x && column + 1 > low.x && row < high.y && row + 1 > low.y;
  });
}

std::array<glm::dvec2, 3> inTexels(const Triangle& triangle, int columns, int rows) {
  const glm::dvec2 size(columns, rows);
  return {triangle.chart[0] * size, triangle.chart[1] * size, triangle.chart[2] * size};
}

std::size_t texelOfCell(std::int64_t column, std::int64_t row, int columns, int rows) {
  const auto i = static_cast<std::size_t>(std::clamp<std::int64_t>(column, 0, columns - 1));
  const auto j = static_cast<std::size_t>(std::clamp<std::int64_t>(row, 0, rows - 1));
  return j * static_cast<std::size_t>(columns) + i;
}

const CutTexel* findCut(std::span<const CutTexel> cut, std::size_t texel) {
  const auto found = std::lower_bound(cut.begin(), cut.end(), texel,
                                      [](const CutTexel& one, std::size_t number) { return one.texel < number; });
  return found != cut.end() && found->texel == texel ? &*found : nullptr;
}

void forEachExposedPiece(const Surface& surface, const TexelGrid& grid, const TexelPieceVisitor& visit) {
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    forEachCell(inTexels(surface.triangles[t], grid.columns, grid.rows),
                [&](std::int64_t column, std::int64_t row, const Piece& piece) {
                  visitCell(t, texelOfCell(column, row, grid.columns, grid.rows), piece, grid, visit);
                });
}

void forEachExposedPiece(const Surface& surface, const TexelGrid& grid, const glm::dvec2& low, const glm::dvec2& high,
                         const TexelPieceVisitor& visit) {
  const bool isCut = hasCutTexel(grid, low, high);
  const auto texelAt = [&](const glm::dvec2& place) {
    return texelOfCell(static_cast<std::int64_t>(std::floor(place.x)), static_cast<std::int64_t>(std::floor(place.y)),
                       grid.columns, grid.rows);
  };
  const auto visitClipped = [&](std::size_t texel, std::uint32_t triangle, const Piece& piece) {
    const Piece inside = clippedTo(piece, low, high);
    if (inside.size > 0) visit(texel, triangle, inside);
  };
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = inTexels(surface.triangles[t], grid.columns, grid.rows);
    if (!meet({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)}, {low, high})) continue;
    const Piece piece = clippedTo(wholeTriangle({a, b, c}), low, high);
    if (piece.size == 0) continue;
    if (!isCut) {
      visit(texelAt(low), t, piece);
      continue;
    }
    forEachCellOf(piece, [&](std::int64_t column, std::int64_t row, const Piece& inCell) {
      visitCell(t, texelOfCell(column, row, grid.columns, grid.rows), inCell, grid, visitClipped);
    });
  }
}

}  // namespace hemitex::radiosity
