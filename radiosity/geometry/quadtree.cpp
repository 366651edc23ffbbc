#include "radiosity/geometry/quadtree.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>

namespace hemitex::radiosity {
namespace {

std::size_t texelIndex(const Quadtree& tree, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(tree.texels) + static_cast<std::size_t>(column);
}

void setSide(Quadtree& tree, const Leaf& leaf, int side) {
  for (int row = leaf.row; row < leaf.row + leaf.side; ++row)
    std::fill_n(tree.leafSide.begin() + static_cast<std::ptrdiff_t>(texelIndex(tree, leaf.column, row)), leaf.side,
                static_cast<std::uint16_t>(side));
}

/// Appends the leaves on `length` texels from (column, row) on, along the row or the column; none outside the grid.
void appendAlong(const Quadtree& tree, int column, int row, bool alongRow, int length, std::vector<Leaf>& leaves) {
  if (column < 0 || row < 0 || column >= tree.texels || row >= tree.texels) return;
  for (int step = 0; step < length;) {
    const Leaf leaf = alongRow ? leafAt(tree, column + step, row) : leafAt(tree, column, row + step);
    leaves.push_back(leaf);
    step += leaf.side;
  }
}

}  // namespace

Quadtree uniformQuadtree(int texels, int leafSide) {
  assert(std::has_single_bit(static_cast<unsigned>(texels)) && std::has_single_bit(static_cast<unsigned>(leafSide)) &&
         leafSide <= texels && texels <= 4096);
  const auto side = static_cast<std::size_t>(texels);
  return {texels, std::vector<std::uint16_t>(side * side, static_cast<std::uint16_t>(leafSide))};
}

Leaf leafAt(const Quadtree& tree, int column, int row) {
  const int side = tree.leafSide[texelIndex(tree, column, row)];
  return {column - column % side, row - row % side, side};
}

std::vector<Leaf> leavesOf(const Quadtree& tree) {
  std::vector<Leaf> leaves;
  for (int row = 0; row < tree.texels; ++row)
    for (int column = 0; column < tree.texels;) {
      const Leaf leaf = leafAt(tree, column, row);
      if (leaf.row == row) leaves.push_back(leaf);
      column += leaf.side;
    }
  return leaves;
}

std::vector<Leaf> neighboursOf(const Quadtree& tree, const Leaf& leaf) {
  std::vector<Leaf> leaves;
  appendAlong(tree, leaf.column, leaf.row - 1, true, leaf.side, leaves);
  appendAlong(tree, leaf.column - 1, leaf.row, false, leaf.side, leaves);
  appendAlong(tree, leaf.column + leaf.side, leaf.row, false, leaf.side, leaves);
  appendAlong(tree, leaf.column, leaf.row + leaf.side, true, leaf.side, leaves);
  return leaves;
}

void split(Quadtree& tree, const Leaf& leaf) {
  assert(leaf.side > 1);
  setSide(tree, leaf, leaf.side / 2);
}

void balance(Quadtree& tree) {
  // Splitting a leaf can make it too small for its larger neighbours, so that those are tested again.
  std::vector<Leaf> pending = leavesOf(tree);
  while (!pending.empty()) {
    const Leaf leaf = pending.back();
    pending.pop_back();
    if (leafAt(tree, leaf.column, leaf.row) != leaf) continue;
    for (const Leaf& neighbour : neighboursOf(tree, leaf)) {
      if (neighbour.side <= 2 * leaf.side) continue;
      split(tree, neighbour);
      const int half = neighbour.side / 2;
      for (const int column : {neighbour.column, neighbour.column + half})
        for (const int row : {neighbour.row, neighbour.row + half}) pending.push_back({column, row, half});
      pending.push_back(leaf);
      break;
    }
  }
}

}  // namespace hemitex::radiosity
