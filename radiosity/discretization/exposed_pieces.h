/// The exposed pieces of a surface: the pieces of its triangles in the texels of its grid, without those inside solids.
/// A solid that stands on a surface buries a part of it, which neither receives nor sends light. Nor do the holes of a
/// cut-out, which count as buried.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "radiosity/cut_outs/texel_mask.h"
#include "radiosity/geometry/grid_clipping.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A part of a triangle inside one texel, with at most eight corners.
struct TexelPiece {
  std::uint32_t triangle = 0;  ///< in Surface::triangles
  Piece piece;                 ///< corners in texels
};

/// A texel that is partly or completely buried, with its exposed pieces.
struct CutTexel {
  std::uint32_t texel = 0;               ///< row * columns + column
  std::vector<TexelPiece> exposed = {};  ///< by triangle
};

/// The texels of a surface's grid, and the cut ones among them, ascending.
struct TexelGrid {
  int columns = 1, rows = 1;
  std::span<const CutTexel> cut;
  const TexelMask* mask = nullptr;  ///< the holes of a cut-out; null without
};

/// The entry of a texel; null if the texel is completely exposed.
const CutTexel* findCut(std::span<const CutTexel> cut, std::size_t texel);

/// Whether a cut texel or a hole intersects the interior of the rectangle [low, high], in texels.
bool hasCutTexel(const TexelGrid& grid, const glm::dvec2& low, const glm::dvec2& high);

/// The chart of a triangle in texels. Exact, because a coordinate has 24 bits and a grid at most 4096 columns and rows.
std::array<glm::dvec2, 3> inTexels(const Triangle& triangle, int columns, int rows);

/// The texel of a grid cell. At u = 1 or v = 1 a chart touches cells beyond the last texels, which map to the last
/// texels.
std::size_t texelOfCell(std::int64_t column, std::int64_t row, int columns, int rows);

/// Called with the texel, the triangle, and the piece of the triangle inside the texel.
using TexelPieceVisitor = std::function<void(std::size_t texel, std::uint32_t triangle, const Piece&)>;

/// Visits the exposed pieces of all triangles in their order. Pieces may have no area.
void forEachExposedPiece(const Surface& surface, const TexelGrid& grid, const TexelPieceVisitor& visit);

/// As above, inside the rectangle [low, high], in texels. Visits every triangle of the surface.
void forEachExposedPiece(const Surface& surface, const TexelGrid& grid, const glm::dvec2& low, const glm::dvec2& high,
                         const TexelPieceVisitor& visit);

}  // namespace hemitex::radiosity
