#include "radiosity/textures/radiosity_texture.h"

#include <algorithm>

#include "radiosity/solver/progressive_solver.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

constexpr std::int64_t maxTexels = std::int64_t{1} << 28;  ///< the limit of readImage

Image emptyTexture(const TextureLayout::Size& size, int magnification) {
  const std::int64_t width = std::int64_t{size.width} * magnification,
                     height = std::int64_t{size.height} * magnification;
  if (width * height > maxTexels)
    throw raster::InputError(
        "a radiosity texture would have " + std::to_string(width) + " x " + std::to_string(height) + " texels",
        "magnify it less, or use fewer texels");
  return {static_cast<int>(width), static_cast<int>(height),
          std::vector<glm::dvec3>(static_cast<std::size_t>(width * height))};
}

/// Writes a surface's values, row by row, to its place and border, all magnified.
void fillPlace(const Grid& grid, const TexturePlace& place, const std::vector<glm::dvec3>& texels, int magnification,
               Image& texture) {
  const int columns = grid.columns * magnification, rows = grid.rows * magnification,
            around = textureBorder * magnification;
  for (int r = -around; r < rows + around; ++r) {
    const int fromTop = texture.height - 1 - (place.row * magnification + r);
    const auto from = texels.begin() + std::ptrdiff_t{std::clamp(r, 0, rows - 1)} * columns;
    const auto to = texture.pixels.begin() + std::ptrdiff_t{fromTop} * texture.width + place.column * magnification;
    std::copy(from, from + columns, to);
    std::fill(to - around, to, *from);
    std::fill(to + columns, to + columns + around, *(from + columns - 1));
  }
}

/// Texture t of the layout.
Image filledTexture(const Discretization& discretization, const TextureLayout& layout, std::size_t t, int magnification,
                    const TexelsOfSurface& texelsOf) {
  Image texture = emptyTexture(layout.textures[t], magnification);
  for (std::uint32_t surface = 0; surface < layout.places.size(); ++surface) {
    const TexturePlace& place = layout.places[surface];
    if (static_cast<std::size_t>(place.texture) == t)
      fillPlace(discretization.grids[surface], place, texelsOf(surface), magnification, texture);
  }
  return texture;
}

std::vector<glm::dvec3> unfilteredTexels(const Grid& grid, const std::vector<glm::dvec3>& radiosity) {
  std::vector<glm::dvec3> texels;
  texels.reserve(grid.elementOfTexel.size());
  for (std::uint32_t element : grid.elementOfTexel) texels.push_back(radiosity[element]);
  return texels;
}

}  // namespace

std::vector<Image> texturesOf(const Discretization& discretization, const TextureLayout& layout,
                              const TexelsOfSurface& texelsOf) {
  std::vector<Image> textures(layout.textures.size());
  raster::parallelFor(textures.size(), [&](std::size_t t) {
    textures[t] = filledTexture(discretization, layout, t, layout.textures[t].magnification, texelsOf);
  });
  return textures;
}

std::vector<Image> radiosityTextures(const Discretization& discretization, const TextureLayout& layout,
                                     const std::vector<glm::dvec3>& radiosity) {
  std::vector<Image> textures;
  for (std::size_t t = 0; t < layout.textures.size(); ++t)
    textures.push_back(filledTexture(discretization, layout, t, 1, [&](std::uint32_t surface) {
      return unfilteredTexels(discretization.grids[surface], radiosity);
    }));
  return textures;
}

Image filteredTexture(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                      std::size_t texture, const std::vector<glm::dvec3>& radiosity, TextureFilter filter,
                      const std::vector<std::vector<BorderEdge>>& borders, const std::vector<ImageLevels>* maps) {
  const int magnification = layout.textures[texture].magnification;
  return filledTexture(discretization, layout, texture, magnification, [&](std::uint32_t surface) {
    std::vector<glm::dvec3> texels = filteredTexels(scene, discretization, surface, radiosity, filter, magnification);
    if (!borders.empty())
      correctBorders(discretization.grids[surface], radiosity, filter, magnification, borders[surface], texels);
    const Grid& grid = discretization.grids[surface];
    if (maps != nullptr && hasMaps(scene, scene.surfaces[surface]))
      applyMaps(scene, *maps, scene.surfaces[surface], grid.columns * magnification, grid.rows * magnification, texels);
    return texels;
  });
}

glm::dvec3 displayRadiosity(const Scene& scene, const Discretization& discretization, const Solution& solution,
                            std::uint32_t element) {
  return solution.radiosity[element] + reflectance(scene, discretization, element) * solution.ambient;
}

std::vector<glm::dvec3> displayRadiosity(const Scene& scene, const Discretization& discretization,
                                         const Solution& solution) {
  std::vector<glm::dvec3> result;
  result.reserve(solution.radiosity.size());
  for (std::uint32_t e = 0; e < solution.radiosity.size(); ++e)
    result.push_back(displayRadiosity(scene, discretization, solution, e));
  return result;
}

std::vector<glm::dvec3> displayValues(const Scene& scene, const Discretization& discretization,
                                      const Solution& solution) {
  std::vector<glm::dvec3> result;
  result.reserve(solution.radiosity.size());
  for (std::uint32_t e = 0; e < solution.radiosity.size(); ++e)
    result.push_back(hasMaps(scene, scene.surfaces[discretization.elements[e].surface])
                         ? solution.irradiance[e] + solution.ambient
                         : displayRadiosity(scene, discretization, solution, e));
  return result;
}

}  // namespace hemitex::radiosity
