/// Quadtrees over the texels of a grid (Samet 1984). The leaves are squares of texels; their sides are powers of two
/// and their positions multiples of the side, so that four leaves form the next larger one. An index map in which the
/// texels of a leaf share an index gives finer elements where needed (Nielsen and Christensen 2002, section 3.3).
#pragma once

#include <cstdint>
#include <vector>

namespace hemitex::radiosity {

/// A square of texels [column, column + side) x [row, row + side).
struct Leaf {
  int column = 0, row = 0;  ///< multiples of the side
  int side = 1;             ///< a power of two

  bool operator==(const Leaf&) const = default;
};

struct Quadtree {
  int texels = 1;                       ///< along a side of the grid: a power of two, at most 4096
  std::vector<std::uint16_t> leafSide;  ///< texels * texels, row by row: the side of the leaf that contains each texel

  bool operator==(const Quadtree&) const = default;
};

/// Equal leaves with `leafSide` texels along a side, a power of two up to `texels`.
Quadtree uniformQuadtree(int texels, int leafSide);

/// The leaf that contains a texel.
Leaf leafAt(const Quadtree& tree, int column, int row);

/// All leaves, ordered by their lowest texels, row by row.
std::vector<Leaf> leavesOf(const Quadtree& tree);

/// The leaves that share a part of an edge with a leaf, each once: below it, left, right, above.
std::vector<Leaf> neighboursOf(const Quadtree& tree, const Leaf& leaf);

/// Replaces a leaf of more than one texel by its four quarters.
void split(Quadtree& tree, const Leaf& leaf);

/// Splits leaves until none is more than twice as wide as a leaf with a common edge.
void balance(Quadtree& tree);

}  // namespace hemitex::radiosity
