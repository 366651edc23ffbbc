#include "radiosity/textures/texture_filter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "radiosity/textures/gouraud_texture.h"
#include "radiosity/textures/quadtree_texture.h"

namespace hemitex::radiosity {
namespace {

/// The grid texels around a position along one axis, with weights; texel centres are integers.
struct Taps {
  int first = 0;
  std::array<double, 5> weight{};
};

Taps tapsAt(TextureFilter filter, double place) {
  Taps taps{static_cast<int>(std::floor(place + 0.5)) - 2, {}};
  for (std::size_t i = 0; i < taps.weight.size(); ++i)
    taps.weight[i] = kernelWeight(filter, taps.first + static_cast<int>(i) - place);
  return taps;
}

/// The weighted mean over the texels with area; there must be at least one.
glm::dvec3 weighted(const Grid& grid, const std::vector<glm::dvec3>& radiosity, const Taps& columns, const Taps& rows) {
  glm::dvec3 sum(0.0);
  double weights = 0;
  for (std::size_t j = 0; j < rows.weight.size(); ++j)
    for (std::size_t i = 0; i < columns.weight.size(); ++i) {
      const int column = columns.first + static_cast<int>(i), row = rows.first + static_cast<int>(j);
      if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) continue;
      const auto texel = static_cast<std::size_t>(row * grid.columns + column);
      const double weight = columns.weight[i] * rows.weight[j];
      if (!grid.covered[texel] || weight == 0) continue;
      sum += weight * radiosity[grid.elementOfTexel[texel]];
      weights += weight;
    }
  return sum / weights;
}

std::vector<glm::dvec3> byKernel(const Discretization& discretization, const Grid& grid,
                                 const std::vector<glm::dvec3>& radiosity, const TextureSettings& settings) {
  const int times = settings.magnification;
  const auto placeOf = [times](int texel) { return (texel + 0.5) / times - 0.5; };
  std::vector<glm::dvec3> texels;
  for (int j = 0; j < grid.rows * times; ++j)
    for (int i = 0; i < grid.columns * times; ++i) {
      const auto texel = static_cast<std::size_t>(j / times * grid.columns + i / times);
      glm::dvec2 place(placeOf(i), placeOf(j));
      if (!grid.covered[texel]) {
        const auto own = static_cast<int>(discretization.elements[grid.elementOfTexel[texel]].texel);
        place = glm::dvec2(own % grid.columns, own / grid.columns);
      }
      texels.push_back(weighted(grid, radiosity, tapsAt(settings.filter, place.x), tapsAt(settings.filter, place.y)));
    }
  return texels;
}

}  // namespace

double kernelWeight(TextureFilter filter, double distance) {
  const double t = std::abs(distance);
  switch (filter) {
    case TextureFilter::OneToOne:
      return t < 0.5 ? 1 : 0;
    case TextureFilter::Triangle:
      return std::max(0.0, 2 - t) / 4;
    case TextureFilter::Bilinear:
      return std::max(0.0, 1 - t);
    case TextureFilter::Bicubic: {
      const double far = std::max(0.0, 2 - t), near = std::max(0.0, 1 - t);
      return (far * far * far - 4 * near * near * near) / 6;
    }
    case TextureFilter::Quadtree:
    case TextureFilter::Gouraud:
      break;
  }
  assert(false);
  return 0;
}

std::vector<glm::dvec3> filteredTexels(const Scene& scene, const Discretization& discretization, std::uint32_t surface,
                                       const std::vector<glm::dvec3>& radiosity, const TextureSettings& settings) {
  const Grid& grid = discretization.grids[surface];
  if (settings.filter == TextureFilter::Quadtree)
    return quadtreeTexels(discretization, grid, radiosity, settings.magnification);
  if (settings.filter == TextureFilter::Gouraud)
    return gouraudTexels(scene.surfaces[surface], grid, radiosity, settings.magnification);
  return byKernel(discretization, grid, radiosity, settings);
}

}  // namespace hemitex::radiosity
