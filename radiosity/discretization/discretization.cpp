#include "radiosity/discretization/discretization.h"

#include <utility>

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
  static const glm::dvec3 none(0);
  if (discretization.grids[surface].isDark) return {none, {}};
  return {scene.materials[static_cast<std::size_t>(scene.surfaces[surface].material)].emission,
          discretization.mappedEmission};
}

glm::dvec3 reflectance(const Scene& scene, const Discretization& discretization, std::uint32_t element) {
  return reflectances(scene, discretization, discretization.elements[element].surface).of(element);
}

glm::dvec3 emission(const Scene& scene, const Discretization& discretization, std::uint32_t element) {
  return emissions(scene, discretization, discretization.elements[element].surface).of(element);
}

std::vector<std::vector<std::uint32_t>> patchesOfSurfaces(const Patches& patches, std::size_t surfaces) {
  std::vector<std::vector<std::uint32_t>> ofSurfaces(surfaces);
  for (const Patch& patch : patches.list) ofSurfaces[patch.surface].push_back(patch.number);
  return ofSurfaces;
}

void replacePatch(Patches& patches, std::uint32_t number, std::vector<Patch> parts) {
  const auto added = static_cast<std::uint32_t>(patches.list.size());
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    Patch& part = parts[i];
    part.number = i == 0 ? number : added + i - 1;
    if (i > 0) part.turn = part.number;
    for (const std::uint32_t element : part.elements) patches.ofElement[element] = part.number;
    if (i == 0)
      patches.list[number] = std::move(part);
    else
      patches.list.push_back(std::move(part));
  }
}

}  // namespace hemitex::radiosity
