/// Quadtrees over texels: leaves, their neighbours, and balance.
#include "radiosity/geometry/quadtree.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/random_quadtrees.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

bool holds(const Leaf& leaf, int column, int row) {
  return column >= leaf.column && column < leaf.column + leaf.side && row >= leaf.row && row < leaf.row + leaf.side;
}

/// Whether two leaves share a part of an edge, more than a corner.
bool touch(const Leaf& a, const Leaf& b) {
  const int across = std::min(a.column + a.side, b.column + b.side) - std::max(a.column, b.column);
  const int along = std::min(a.row + a.side, b.row + b.side) - std::max(a.row, b.row);
  return std::min(across, along) == 0 && std::max(across, along) > 0;
}

/// Balances by splitting any leaf that is too large, until none is.
Quadtree balancedSlowly(Quadtree tree) {
  for (;;) {
    const std::vector<Leaf> leaves = leavesOf(tree);
    const auto tooLarge = std::find_if(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
      return std::any_of(leaves.begin(), leaves.end(),
                         [&](const Leaf& other) { return touch(leaf, other) && leaf.side > 2 * other.side; });
    });
    if (tooLarge == leaves.end()) return tree;
    split(tree, *tooLarge);
  }
}

}  // namespace

TEST_CASE("leavesOf tiles the grid in the order of the lowest texels, at multiples of the sides", "[quadtree]") {
  std::mt19937 random(1);
  for (const int texels : {1, 2, 8, 32}) {
    const Quadtree tree = randomQuadtree(texels, random);
    const std::vector<Leaf> leaves = leavesOf(tree);
    CHECK(std::is_sorted(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
      return std::pair(a.row, a.column) < std::pair(b.row, b.column);
    }));
    for (const Leaf& leaf : leaves) CHECK((leaf.column % leaf.side == 0 && leaf.row % leaf.side == 0));
    for (int row = 0; row < texels; ++row)
      for (int column = 0; column < texels; ++column) {
        CHECK(std::count_if(leaves.begin(), leaves.end(), [&](const Leaf& l) { return holds(l, column, row); }) == 1);
        CHECK(holds(leafAt(tree, column, row), column, row));
      }
  }
}

TEST_CASE("split replaces a leaf by its quarters", "[quadtree]") {
  Quadtree tree = uniformQuadtree(8, 4);
  split(tree, {4, 0, 4});
  CHECK(leavesOf(tree) ==
        std::vector<Leaf>{{0, 0, 4}, {4, 0, 2}, {6, 0, 2}, {4, 2, 2}, {6, 2, 2}, {0, 4, 4}, {4, 4, 4}});
}

TEST_CASE("neighboursOf gives the leaves that share a part of an edge, each once", "[quadtree]") {
  std::mt19937 random(2);
  for (int round = 0; round < 10; ++round) {
    const Quadtree tree = randomQuadtree(16, random);
    const std::vector<Leaf> leaves = leavesOf(tree);
    for (const Leaf& leaf : leaves) {
      const std::vector<Leaf> neighbours = neighboursOf(tree, leaf);
      CHECK(neighbours.size() == std::size_t(std::count_if(leaves.begin(), leaves.end(),
                                                           [&](const Leaf& other) { return touch(leaf, other); })));
      for (const Leaf& other : neighbours) {
        CHECK(touch(leaf, other));
        CHECK(std::count(neighbours.begin(), neighbours.end(), other) == 1);
      }
    }
  }
}

TEST_CASE("balance splits only leaves that are too large for a neighbour", "[quadtree]") {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    Quadtree tree = randomQuadtree(16, random);
    // One deep corner beside large leaves: splits must propagate.
    if (round == 0) {
      tree = uniformQuadtree(16, 16);
      for (int side = 16; side > 1; side /= 2) split(tree, leafAt(tree, 7, 7));
    }
    const Quadtree slow = balancedSlowly(tree);
    balance(tree);
    CHECK(tree == slow);
  }
}
