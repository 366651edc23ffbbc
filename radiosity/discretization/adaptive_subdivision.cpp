#include "radiosity/discretization/adaptive_subdivision.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <optional>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/grid_size.h"

namespace hemitex::radiosity {
namespace {

/// The element of each leaf, at its lowest texel; nothing for leaves without area.
std::vector<std::optional<std::uint32_t>> elementsOfLeaves(const Discretization& discretization, const Grid& grid) {
  std::vector<std::optional<std::uint32_t>> elements(grid.elementOfTexel.size());
  for (const std::uint32_t e : elementsOf(grid)) {
    const Leaf leaf = leafOf(grid, discretization.elements[e].texel);
    elements[static_cast<std::size_t>(leaf.row * grid.columns + leaf.column)] = e;
  }
  return elements;
}

/// The change of radiosity across a leaf in the direction of a neighbour.
double changeTo(const Leaf& leaf, const glm::dvec3& own, const Leaf& neighbour, const glm::dvec3& other) {
  return bandSum(glm::abs(other - own)) * leaf.side / ((leaf.side + neighbour.side) / 2.0);
}

Quadtree refinedTree(const Discretization& discretization, const Grid& grid, std::span<const glm::dvec3> radiosity,
                     double maxFlux) {
  const auto elements = elementsOfLeaves(discretization, grid);
  const auto elementOf = [&](const Leaf& leaf) {
    return elements[static_cast<std::size_t>(leaf.row * grid.columns + leaf.column)];
  };
  Quadtree tree = *grid.quadtree;
  for (const Leaf& leaf : leavesOf(*grid.quadtree)) {
    const std::optional<std::uint32_t> own = elementOf(leaf);
    if (leaf.side == 1 || !own) continue;
    double change = 0;
    for (const Leaf& neighbour : neighboursOf(*grid.quadtree, leaf))
      if (const std::optional<std::uint32_t> other = elementOf(neighbour))
        change = std::max(change, changeTo(leaf, radiosity[*own], neighbour, radiosity[*other]));
    if (discretization.elements[*own].area * change > maxFlux) split(tree, leaf);
  }
  balance(tree);
  return tree;
}

/// The quadtree of a surface before the first round.
Quadtree coarseTree(int texels) { return uniformQuadtree(texels, std::max(1, texels / coarsestElements)); }

/// The settings with 2^n x 2^n texels for each surface, at least as many as the given ones.
DiscretizationSettings withQuadtrees(const Scene& scene, DiscretizationSettings settings) {
  const std::vector<GridSize> sizes = gridSizesOf(scene, settings);
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const int longer = std::max(sizes[s].columns, sizes[s].rows);
    settings.surfaceTexels[scene.surfaces[s].name] = static_cast<int>(std::bit_ceil(static_cast<unsigned>(longer)));
  }
  return settings;
}

}  // namespace

std::vector<Quadtree> refined(const Discretization& discretization, std::span<const glm::dvec3> radiosity,
                              double tolerance) {
  assert(radiosity.size() == discretization.elements.size());
  double flux = 0;
  for (std::size_t e = 0; e < radiosity.size(); ++e) flux += discretization.elements[e].area * bandSum(radiosity[e]);
  std::vector<Quadtree> trees;
  for (const Grid& grid : discretization.grids)
    trees.push_back(refinedTree(discretization, grid, radiosity, tolerance * flux));
  return trees;
}

Discretization adaptiveDiscretization(const Scene& scene, const DiscretizationSettings& given, double tolerance,
                                      const SolveElements& solveElements) {
  const DiscretizationSettings settings = withQuadtrees(scene, given);
  std::vector<Quadtree> trees;
  for (const Surface& surface : scene.surfaces) trees.push_back(coarseTree(gridSizeOf(surface, settings).columns));
  for (;;) {
    Discretization discretization = discretize(scene, settings, trees);
    std::vector<Quadtree> finer = refined(discretization, solveElements(discretization), tolerance);
    if (finer == trees) return discretization;
    trees = std::move(finer);
  }
}

}  // namespace hemitex::radiosity
