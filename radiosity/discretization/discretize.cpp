#include "radiosity/discretization/discretize.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/discretization/grid_size.h"
#include "radiosity/discretization/material_averages.h"
#include "radiosity/discretization/sliver_merging.h"
#include "radiosity/discretization/texel_areas.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

using raster::InputError;

bool isNamed(const Surface& surface, const std::string& name) { return surface.name == name || surface.family == name; }

std::string someNames(const Scene& scene) {
  std::string names;
  std::size_t listed = 0;
  const std::string* previous = nullptr;
  for (const Surface& surface : scene.surfaces) {
    if (previous != nullptr && *previous == surface.family) continue;
    if (listed++ == 10) return names + ", ...";
    names += (names.empty() ? "" : ", ") + surface.family;
    previous = &surface.family;
  }
  return names;
}

void validateTexels(int texels, const std::string& what) {
  if (texels < 1 || texels > largestGrid)
    throw InputError(what + " has " + std::to_string(texels) + " texels along a side",
                     "use 1 to " + std::to_string(largestGrid));
}

void validate(const Scene& scene, const DiscretizationSettings& settings) {
  if (settings.texels) validateTexels(*settings.texels, "the discretization");
  if (settings.texelSize && !(*settings.texelSize > 0 && std::isfinite(*settings.texelSize)))
    throw InputError("the size of a texel is not above 0", "give a length in the scene's units");
  if (settings.patch < 1)
    throw InputError("a patch has " + std::to_string(settings.patch) + " texels along a side", "use 1 or more");
  validateTexels(settings.maxTexels, "the largest grid");
  if (settings.subdivision < 1)
    throw InputError("a texel is cut into " + std::to_string(settings.subdivision) + " along a side", "use 1 or more");
  if (settings.patches && *settings.patches < 1)
    throw InputError("a surface has " + std::to_string(*settings.patches) + " patches along a side", "use 1 or more");
  for (const auto& [name, texels] : settings.surfaceTexels) {
    validateTexels(texels.columns, "surface '" + name + "'");
    validateTexels(texels.rows, "surface '" + name + "'");
    const bool exists = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                    [&name = name](const Surface& surface) { return isNamed(surface, name); });
    if (!exists)
      throw InputError("the scene has no surface named '" + name + "'", "its surfaces are " + someNames(scene));
  }
}

bool coversAny(const TexelAreas& texels) {
  return std::any_of(texels.coverage.begin(), texels.coverage.end(), [](double c) { return c > coverageNoise; });
}

/// If the charts of all triangles have no area, the texel with the largest surface area represents the surface.
void coverOneAtLeast(TexelAreas& texels) {
  if (coversAny(texels)) return;
  const auto largest = std::max_element(texels.area.begin(), texels.area.end()) - texels.area.begin();
  texels.coverage[static_cast<std::size_t>(largest)] = 1;
}

/// The number of a leaf's lowest texel.
std::uint32_t lowestTexel(const Grid& grid, const Leaf& leaf) {
  return static_cast<std::uint32_t>(leaf.row * grid.columns + leaf.column);
}

/// The representative triangles of leaves: a leaf is a texel of a coarser grid.
class LeafTriangles {
 public:
  LeafTriangles(const Surface& surface, const Grid& grid) : surface_(surface), grid_(grid) {}

  std::uint32_t of(const Leaf& leaf) {
    const int columns = grid_.columns / leaf.side, rows = grid_.rows / leaf.side;
    const auto [found, isNew] = bySide_.try_emplace(leaf.side);
    if (isNew) found->second = texelAreas(surface_, {columns, rows, {}}).triangle;
    return found->second[texelOfCell(leaf.column / leaf.side, leaf.row / leaf.side, columns, rows)];
  }

 private:
  const Surface& surface_;
  const Grid& grid_;
  std::map<int, std::vector<std::uint32_t>> bySide_;
};

/// Makes elements of texels, ordered by their own texels, and adds the area of each texel to the element it maps to.
void makeElements(const Surface& surface, std::uint32_t number, Discretization& part) {
  constexpr std::uint32_t none = ~0u;
  Grid& grid = part.grids.front();
  TexelAreas texels = texelAreas(surface, texelGrid(grid));
  if (grid.mask && !coversAny(texels)) {  // all holes
    grid.isDark = true;
    texels = texelAreas(surface, texelGrid(grid));
  }
  coverOneAtLeast(texels);
  grid.elementOfTexel = mergeSlivers(grid.columns, grid.rows, texels.coverage);
  LeafTriangles triangles(surface, grid);
  std::vector<std::uint32_t> elementOf(grid.elementOfTexel.size(), none);  // by the lowest texel of its leaf
  const auto elementAt = [&](std::uint32_t own) -> std::uint32_t& {
    return elementOf[lowestTexel(grid, leafOf(grid, own))];
  };
  for (std::uint32_t texel = 0; texel < grid.elementOfTexel.size(); ++texel) {
    grid.covered.push_back(texels.coverage[texel] > coverageNoise);
    grid.phantoms += grid.covered[texel] ? 0 : 1;
    grid.buried += grid.covered[texel] || findCut(grid.cutTexels, texel) == nullptr ? 0 : 1;
    if (grid.elementOfTexel[texel] != texel || elementAt(texel) != none) continue;
    elementAt(texel) = static_cast<std::uint32_t>(part.elements.size());
    const Leaf leaf = leafOf(grid, texel);
    part.elements.push_back({0, number, texel});
    part.triangleOf.push_back(leaf.side == 1 ? texels.triangle[texel] : triangles.of(leaf));
  }
  for (std::uint32_t texel = 0; texel < grid.elementOfTexel.size(); ++texel) {
    grid.elementOfTexel[texel] = elementAt(grid.elementOfTexel[texel]);
    part.elements[grid.elementOfTexel[texel]].area += texels.area[texel];
  }
  grid.elementCount = static_cast<std::uint32_t>(part.elements.size());
}

/// The number of texels along the side of a surface's patches.
int patchSide(const GridSize& size, const DiscretizationSettings& settings) {
  if (!settings.patches) return std::min(settings.patch, largestGrid);
  const int longer = std::max(size.columns, size.rows);
  return std::max(1, longer / *settings.patches);
}

/// Groups the elements by the block of texels that contains their own texel, or the lowest texel of their leaf. A leaf
/// larger than a block is the only element in it and enlarges it.
void makePatches(std::uint32_t surface, int side, Discretization& part) {
  Grid& grid = part.grids.front();
  const int blockColumns = (grid.columns + side - 1) / side;
  const auto blockOf = [&](const Element& element) {
    const Leaf leaf = leafOf(grid, element.texel);
    return static_cast<std::size_t>(leaf.row / side * blockColumns + leaf.column / side);
  };
  struct Block {
    std::uint32_t elements = 0;
    int side = 0;
  };
  std::vector<Block> blocks(static_cast<std::size_t>(blockColumns * ((grid.rows + side - 1) / side)));
  for (const Element& element : part.elements) {
    Block& block = blocks[blockOf(element)];
    ++block.elements;
    block.side = std::max(side, leafOf(grid, element.texel).side);
  }
  std::vector<std::uint32_t> patchOf(blocks.size());
  std::vector<Patch>& patches = part.patches.list;
  for (std::size_t number = 0; number < blocks.size(); ++number) {
    const Block& block = blocks[number];
    if (block.elements == 0) continue;
    const int column = static_cast<int>(number) % blockColumns * side,
              row = static_cast<int>(number) / blockColumns * side;
    patchOf[number] = static_cast<std::uint32_t>(patches.size());
    patches.push_back({.surface = surface,
                       .column = column,
                       .row = row,
                       .width = std::min(block.side, grid.columns - column),
                       .height = std::min(block.side, grid.rows - row)});
    patches.back().elements.reserve(block.elements);
  }
  for (std::uint32_t element = 0; element < part.elements.size(); ++element) {
    const std::uint32_t number = patchOf[blockOf(part.elements[element])];
    part.patches.ofElement.push_back(number);
    patches[number].elements.push_back(element);
    patches[number].area += part.elements[element].area;
  }
  grid.patchCount = static_cast<std::uint32_t>(patches.size());
}

/// Leaves and blocks of texels nest if the sides of both are powers of two.
void validateNesting(const Surface& surface, const GridSize& size, const Quadtree& quadtree, int side) {
  assert(quadtree.texels == size.columns && quadtree.texels == size.rows);
  if (!std::has_single_bit(static_cast<unsigned>(side)))
    throw InputError("a patch of surface '" + surface.name + "' has " + std::to_string(side) + " texels along a side",
                     "over quadtrees use a power of two");
}

bool hasMap(const Scene& scene, std::optional<int> Material::*map) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
    return (scene.materials[static_cast<std::size_t>(surface.material)].*map).has_value() ||
           (map == &Material::reflectanceMap && surface.hasColours);
  });
}

/// The discretization of one surface; elements and patches are numbered from 0. `quadtree` may be null.
Discretization discretizeSurface(const Scene& scene, std::uint32_t number, const DiscretizationSettings& settings,
                                 const GridSize& size, const Quadtree* quadtree, const Exposure& exposure,
                                 const std::shared_ptr<const TexelMask>& mask) {
  const Surface& surface = scene.surfaces[number];
  Discretization part;
  part.grids.push_back({.columns = size.columns, .rows = size.rows, .elementOfTexel = {}, .covered = {}});
  if (quadtree) part.grids.front().quadtree = *quadtree;
  part.grids.front().cutTexels = exposure.cutTexels;
  part.grids.front().isDark = exposure.isBuried;
  part.grids.front().mask = mask;
  makeElements(surface, number, part);
  const int side = patchSide(size, settings);
  if (quadtree) validateNesting(surface, size, *quadtree, side);
  makePatches(number, side, part);
  return part;
}

/// Appends the discretization of some surfaces to that of the surfaces before them.
void append(Discretization& whole, Discretization part) {
  const auto firstElement = static_cast<std::uint32_t>(whole.elements.size());
  const auto firstPatch = static_cast<std::uint32_t>(whole.patches.list.size());
  for (Grid& grid : part.grids) {
    grid.firstElement += firstElement;
    grid.firstPatch += firstPatch;
    for (std::uint32_t& element : grid.elementOfTexel) element += firstElement;
  }
  for (std::uint32_t& patch : part.patches.ofElement) patch += firstPatch;
  for (Patch& patch : part.patches.list) {
    patch.number = patch.turn = static_cast<std::uint32_t>(whole.patches.list.size());
    for (std::uint32_t& element : patch.elements) element += firstElement;
    whole.patches.list.push_back(std::move(patch));
  }
  std::move(part.grids.begin(), part.grids.end(), std::back_inserter(whole.grids));
  const auto moveTo = [](auto& all, const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
  moveTo(whole.elements, part.elements);
  moveTo(whole.patches.ofElement, part.patches.ofElement);
  moveTo(whole.triangleOf, part.triangleOf);
}

/// Joins the discretizations of consecutive surfaces; each is released as soon as it is copied.
Discretization joined(std::vector<Discretization> parts) {
  std::size_t grids = 0, elements = 0, patches = 0;
  for (const Discretization& part : parts) {
    grids += part.grids.size();
    elements += part.elements.size();
    patches += part.patches.list.size();
  }
  Discretization whole;
  whole.grids.reserve(grids);
  whole.elements.reserve(elements);
  whole.patches.ofElement.reserve(elements);
  whole.triangleOf.reserve(elements);
  whole.patches.list.reserve(patches);
  for (Discretization& part : parts) append(whole, std::exchange(part, {}));
  return whole;
}

/// The end of the surfaces from `first` on that are discretized before their parts are joined. Many small parts leave
/// gaps in memory, so that they should not be there for all surfaces at once.
std::size_t endOfBlock(std::span<const GridSize> sizes, std::size_t first) {
  constexpr std::int64_t texelsAtOnce = std::int64_t{1} << 24;
  std::int64_t texels = 0;
  std::size_t end = first;
  for (; end < sizes.size() && texels < texelsAtOnce; ++end)
    texels += std::int64_t{sizes[end].columns} * sizes[end].rows;
  return end;
}

/// Discretizes all surfaces one after the other. One quadtree per surface or none at all.
Discretization assembled(const Scene& scene, const DiscretizationSettings& settings, std::span<const GridSize> sizes,
                         const std::vector<Quadtree>& quadtrees, const std::vector<Exposure>& exposure) {
  std::vector<Discretization> blocks;
  TexelMasks masks(scene);
  std::vector<std::shared_ptr<const TexelMask>> maskOf;
  for (std::size_t s = 0; s < sizes.size(); ++s)
    maskOf.push_back(masks.of(scene.surfaces[s], sizes[s].columns, sizes[s].rows));
  for (std::size_t first = 0, end = 0; first < scene.surfaces.size(); first = end) {
    end = endOfBlock(sizes, first);
    std::vector<Discretization> parts(end - first);
    raster::parallelFor(parts.size(), [&](std::size_t i) {
      const std::size_t surface = first + i;
      const Quadtree* quadtree = quadtrees.empty() ? nullptr : &quadtrees[surface];
      parts[i] = discretizeSurface(scene, static_cast<std::uint32_t>(surface), settings, sizes[surface], quadtree,
                                   exposure[surface], maskOf[surface]);
    });
    blocks.push_back(joined(std::move(parts)));
  }
  return joined(std::move(blocks));
}

/// One quadtree per surface, or none at all.
Discretization discretized(const Scene& scene, const DiscretizationSettings& asked,
                           const std::vector<Quadtree>& quadtrees) {
  validate(scene, asked);
  const DiscretizationSettings settings = followingScene(scene, asked);
  const std::vector<GridSize> sizes = gridSizesOf(scene, settings);
  requireAffordable(scene, sizes);
  std::vector<Exposure> exposure(scene.surfaces.size());
  if (!settings.isUnburied) exposure = findExposure(scene, sizes);
  Discretization whole = assembled(scene, settings, sizes, quadtrees, exposure);
  averageMaps(scene, whole);
  return whole;
}

}  // namespace

Discretization discretize(const Scene& scene, const DiscretizationSettings& settings) {
  return discretized(scene, settings, {});
}

Discretization discretize(const Scene& scene, const DiscretizationSettings& settings,
                          const std::vector<Quadtree>& quadtrees) {
  assert(quadtrees.size() == scene.surfaces.size());
  return discretized(scene, settings, quadtrees);
}

Discretization discretizeUnburied(const Scene& scene, const DiscretizationSettings& settings) {
  DiscretizationSettings unburied = settings;
  unburied.isUnburied = true;
  return discretize(scene, unburied);
}

void averageMaps(const Scene& scene, Discretization& discretization) {
  const auto valuesOf = [&](glm::dvec3 Material::*value, std::optional<int> Material::*map) {
    std::vector<glm::dvec3> values;
    if (!hasMap(scene, map)) return values;
    const std::vector<std::vector<glm::dvec3>> means = meansOfMap(scene, discretization.grids, map);
    for (std::size_t s = 0; s < means.size(); ++s)
      for (const glm::dvec3& mean : means[s])
        values.push_back(mean * scene.materials[static_cast<std::size_t>(scene.surfaces[s].material)].*value);
    return values;
  };
  discretization.mappedReflectance = valuesOf(&Material::reflectance, &Material::reflectanceMap);
  for (glm::dvec3& value : discretization.mappedReflectance) value = glm::min(value, glm::dvec3(maxMappedReflectance));
  discretization.mappedEmission = valuesOf(&Material::emission, &Material::emissionMap);
}

}  // namespace hemitex::radiosity
