/// Random quadtrees.
#pragma once

#include <random>

#include "radiosity/geometry/quadtree.h"

namespace hemitex::tests {

/// Leaves of texels x texels split at random, three in five of each size.
inline radiosity::Quadtree randomQuadtree(int texels, std::mt19937& random) {
  radiosity::Quadtree tree = radiosity::uniformQuadtree(texels, texels);
  for (int side = texels; side > 1; side /= 2)
    for (const radiosity::Leaf& leaf : radiosity::leavesOf(tree))
      if (leaf.side == side && random() % 5 < 3) radiosity::split(tree, leaf);
  return tree;
}

inline radiosity::Quadtree randomBalancedQuadtree(int texels, std::mt19937& random) {
  radiosity::Quadtree tree = randomQuadtree(texels, random);
  radiosity::balance(tree);
  return tree;
}

}  // namespace hemitex::tests
