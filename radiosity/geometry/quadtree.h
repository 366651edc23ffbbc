/// Quadtrees over the texels of a grid (Samet 1984): squares of texels, the leaves, each a power of two wide and at a
/// multiple of its side, so that four of them make the next larger one. As an index map in which several texels share
/// an index, a quadtree is a discretization that is finer where it needs to be (Nielsen and Christensen 2002, 3.3).
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
  std::vector<std::uint16_t> leafSide;  ///< texels * texels, row by row: the side of the leaf that holds each texel

  bool operator==(const Quadtree&) const = default;
};

/// Equal leaves of `leafSide` texels a side, a power of two up to `texels`.
Quadtree uniformQuadtree(int texels, int leafSide);

/// The leaf that holds a texel.
Leaf leafAt(const Quadtree& tree, int column, int row);

/// All leaves, ordered by their lowest texels, row by row.
std::vector<Leaf> leavesOf(const Quadtree& tree);

/// The leaves that share a part of an edge with a leaf, each once: below it, left, right, above.
std::vector<Leaf> neighboursOf(const Quadtree& tree, const Leaf& leaf);

/// Puts its four quarters in the place of a leaf of more than one texel.
void split(Quadtree& tree, const Leaf& leaf);

/// Splits leaves until none is more than twice as wide as one that it shares an edge with.
void balance(Quadtree& tree);

}  // namespace hemitex::radiosity
