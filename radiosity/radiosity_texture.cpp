#include "radiosity/radiosity_texture.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include "radiosity/file_names.h"
#include "radiosity/rectangle_packing.h"

namespace hemitex::radiosity {
namespace {

constexpr int border = 1;
constexpr int largestTexture = 4096;

std::size_t texelIndex(const Grid& grid, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
}

TextureLayout packTextures(const std::vector<RectangleSize>& sizes) {
  const Packing packing = packRectangles(sizes, largestTexture);
  TextureLayout layout;
  for (const RectangleSize& page : packing.pages) {
    layout.textures.push_back({page.width, page.height});
    layout.names.push_back("radiosity-" + std::to_string(layout.textures.size()));
  }
  for (const RectanglePlace& place : packing.places)
    layout.places.push_back({place.page, place.column + border, place.row + border});
  return layout;
}

TextureLayout separateTextures(const Scene& scene, const std::vector<RectangleSize>& sizes) {
  TextureLayout layout;
  for (std::size_t surface = 0; surface < sizes.size(); ++surface) {
    layout.textures.push_back({sizes[surface].width, sizes[surface].height});
    layout.names.push_back(scene.surfaces[surface].name);
    layout.places.push_back({static_cast<int>(surface), border, border});
  }
  layout.names = uniqueFileNames(layout.names, {"render"});  // the picture that stands beside them
  return layout;
}

/// Writes a value a texel, row by row, into a surface's place and its border.
void fillPlace(const Grid& grid, const TexturePlace& place, const std::vector<glm::dvec3>& texels, Image& texture) {
  for (int r = -border; r < grid.rows + border; ++r)
    for (int c = -border; c < grid.columns + border; ++c) {
      const int column = std::clamp(c, 0, grid.columns - 1), row = std::clamp(r, 0, grid.rows - 1);
      const int fromTop = texture.height - 1 - (place.row + r);
      const auto pixel = static_cast<std::size_t>(fromTop) * static_cast<std::size_t>(texture.width) +
                         static_cast<std::size_t>(place.column + c);
      texture.pixels[pixel] = texels[texelIndex(grid, column, row)];
    }
}

using TexelsOf = std::function<std::vector<glm::dvec3>(const Grid&)>;

std::vector<Image> fillTextures(const Discretization& discretization, const TextureLayout& layout,
                                const TexelsOf& texelsOf) {
  std::vector<Image> textures;
  for (const TextureLayout::Size& size : layout.textures)
    textures.push_back(
        {size.width, size.height,
         std::vector<glm::dvec3>(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height))});
  for (std::size_t surface = 0; surface < layout.places.size(); ++surface) {
    const Grid& grid = discretization.grids[surface];
    const TexturePlace& place = layout.places[surface];
    fillPlace(grid, place, texelsOf(grid), textures[static_cast<std::size_t>(place.texture)]);
  }
  return textures;
}

std::vector<glm::dvec3> unfilteredTexels(const Grid& grid, const std::vector<glm::dvec3>& radiosity) {
  std::vector<glm::dvec3> texels;
  texels.reserve(grid.spill.size());
  for (std::uint32_t element : grid.spill) texels.push_back(radiosity[element]);
  return texels;
}

/// The (1 2 1) filter of the texels around (column, row), over those that have area; there is one at least.
glm::dvec3 filteredTexel(const Grid& grid, const std::vector<glm::dvec3>& texels, int column, int row) {
  glm::dvec3 sum(0.0);
  int weights = 0;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows - 1); ++r)
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid.columns - 1); ++c) {
      const std::size_t texel = texelIndex(grid, c, r);
      if (!grid.covered[texel]) continue;
      const int weight = (r == row ? 2 : 1) * (c == column ? 2 : 1);
      sum += static_cast<double>(weight) * texels[texel];
      weights += weight;
    }
  return sum / static_cast<double>(weights);
}

std::vector<glm::dvec3> filteredTexels(const Discretization& discretization, const Grid& grid,
                                       const std::vector<glm::dvec3>& radiosity) {
  const std::vector<glm::dvec3> texels = unfilteredTexels(grid, radiosity);
  std::vector<glm::dvec3> filtered(texels.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t texel = texelIndex(grid, column, row);
      if (grid.covered[texel]) filtered[texel] = filteredTexel(grid, texels, column, row);
    }
  for (std::size_t texel = 0; texel < texels.size(); ++texel)
    if (!grid.covered[texel]) filtered[texel] = filtered[discretization.elements[grid.spill[texel]].texel];
  return filtered;
}

bool isZero(const glm::dvec3& value) { return value == glm::dvec3(0.0); }

/// The mean over all elements, or over those alone that do not emit.
std::optional<double> meanRadiosity(const Scene& scene, const Discretization& discretization,
                                    const std::vector<glm::dvec3>& radiosity, bool withEmitters) {
  double flux = 0, totalArea = 0;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    if (!withEmitters && !isZero(emission(scene, discretization, e))) continue;
    const glm::dvec3& b = radiosity[e];
    flux += discretization.elements[e].area * ((b.x + b.y + b.z) / 3);
    totalArea += discretization.elements[e].area;
  }
  return totalArea > 0 ? std::optional(flux / totalArea) : std::nullopt;
}

}  // namespace

TextureLayout layOutTextures(const Scene& scene, const Discretization& discretization, std::size_t separateLimit) {
  assert(discretization.grids.size() == scene.surfaces.size());
  std::vector<RectangleSize> sizes;
  for (const Grid& grid : discretization.grids) sizes.push_back({grid.columns + 2 * border, grid.rows + 2 * border});
  return sizes.size() <= separateLimit ? separateTextures(scene, sizes) : packTextures(sizes);
}

glm::dvec2 textureCoordinate(const Discretization& discretization, const TextureLayout& layout, std::uint32_t surface,
                             const glm::dvec2& chart) {
  const Grid& grid = discretization.grids[surface];
  const TexturePlace& place = layout.places[surface];
  const TextureLayout::Size& size = layout.textures[static_cast<std::size_t>(place.texture)];
  return {(place.column + chart.x * grid.columns) / size.width, (place.row + chart.y * grid.rows) / size.height};
}

std::vector<Image> radiosityTextures(const Discretization& discretization, const TextureLayout& layout,
                                     const std::vector<glm::dvec3>& radiosity) {
  return fillTextures(discretization, layout, [&](const Grid& grid) { return unfilteredTexels(grid, radiosity); });
}

std::vector<Image> filteredTextures(const Discretization& discretization, const TextureLayout& layout,
                                    const std::vector<glm::dvec3>& radiosity) {
  return fillTextures(discretization, layout,
                      [&](const Grid& grid) { return filteredTexels(discretization, grid, radiosity); });
}

std::vector<glm::dvec3> displayRadiosity(const Scene& scene, const Discretization& discretization,
                                         const Solution& solution) {
  std::vector<glm::dvec3> result;
  result.reserve(solution.radiosity.size());
  for (std::uint32_t e = 0; e < solution.radiosity.size(); ++e)
    result.push_back(solution.radiosity[e] + reflectance(scene, discretization, e) * solution.ambient);
  return result;
}

double defaultExposure(const Scene& scene, const Discretization& discretization,
                       const std::vector<glm::dvec3>& radiosity) {
  std::optional<double> mean = meanRadiosity(scene, discretization, radiosity, false);
  if (!mean) mean = meanRadiosity(scene, discretization, radiosity, true);
  return mean && *mean > 0 ? 0.18 / *mean : 1;
}

}  // namespace hemitex::radiosity
