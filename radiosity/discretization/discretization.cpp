#include "radiosity/discretization/discretization.h"

#include <numeric>

namespace hemitex::radiosity {

Leaf leafOf(const Grid& grid, std::uint32_t texel) {
  const int column = static_cast<int>(texel) % grid.columns, row = static_cast<int>(texel) / grid.columns;
  return grid.quadtree ? leafAt(*grid.quadtree, column, row) : Leaf{column, row, 1};
}

SurfaceValues reflectances(const Scene& scene, const Discretization& discretization, std::uint32_t surface) {
  return {scene.materials[static_cast<std::size_t>(scene.surfaces[surface].material)].reflectance,
          discretization.mappedReflectance};
}

SurfaceValues emissions(const Scene& scene, const Discretization& discretization, std::uint32_t surface) {
  return {scene.materials[static_cast<std::size_t>(scene.surfaces[surface].material)].emission,
          discretization.mappedEmission};
}

glm::dvec3 reflectance(const Scene& scene, const Discretization& discretization, std::uint32_t element) {
  return reflectances(scene, discretization, discretization.elements[element].surface).of(element);
}

glm::dvec3 emission(const Scene& scene, const Discretization& discretization, std::uint32_t element) {
  return emissions(scene, discretization, discretization.elements[element].surface).of(element);
}

std::vector<std::uint32_t> patchesOf(const Grid& grid) {
  std::vector<std::uint32_t> patches(grid.patchCount);
  std::iota(patches.begin(), patches.end(), grid.firstPatch);
  patches.insert(patches.end(), grid.laterPatches.begin(), grid.laterPatches.end());
  return patches;
}

double patchArea(const Discretization& discretization, const Patch& patch) {
  double area = 0;
  for (std::uint32_t i = 0; i < patch.elementCount; ++i)
    area += discretization.elements[discretization.patchElements[patch.firstElement + i]].area;
  return area;
}

}  // namespace hemitex::radiosity
