#include "radiosity/textures/radiosity_texture.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include "radiosity/geometry/rectangle_packing.h"
#include "radiosity/textures/file_names.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

constexpr int border = 1;
constexpr int largestTexture = 4096;
constexpr std::int64_t maxTexels = std::int64_t{1} << 28;  ///< the limit of readImage

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
  layout.names = uniqueFileNames(layout.names, {"render"});  // render.png is in the same folder
  return layout;
}

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
  const int columns = grid.columns * magnification, rows = grid.rows * magnification, around = border * magnification;
  for (int r = -around; r < rows + around; ++r)
    for (int c = -around; c < columns + around; ++c) {
      const int column = std::clamp(c, 0, columns - 1), row = std::clamp(r, 0, rows - 1);
      const int fromTop = texture.height - 1 - (place.row * magnification + r);
      const auto pixel = static_cast<std::size_t>(fromTop) * static_cast<std::size_t>(texture.width) +
                         static_cast<std::size_t>(place.column * magnification + c);
      texture.pixels[pixel] =
          texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
    }
}

/// The values of a surface's texels.
using TexelsOf = std::function<std::vector<glm::dvec3>(std::uint32_t surface)>;

std::vector<Image> fillTextures(const Discretization& discretization, const TextureLayout& layout, int magnification,
                                const TexelsOf& texelsOf) {
  std::vector<Image> textures;
  for (const TextureLayout::Size& size : layout.textures) textures.push_back(emptyTexture(size, magnification));
  for (std::uint32_t surface = 0; surface < layout.places.size(); ++surface) {
    const TexturePlace& place = layout.places[surface];
    fillPlace(discretization.grids[surface], place, texelsOf(surface), magnification,
              textures[static_cast<std::size_t>(place.texture)]);
  }
  return textures;
}

std::vector<glm::dvec3> unfilteredTexels(const Grid& grid, const std::vector<glm::dvec3>& radiosity) {
  std::vector<glm::dvec3> texels;
  texels.reserve(grid.elementOfTexel.size());
  for (std::uint32_t element : grid.elementOfTexel) texels.push_back(radiosity[element]);
  return texels;
}

bool isZero(const glm::dvec3& value) { return value == glm::dvec3(0.0); }

/// The mean over all elements, or only over those that do not emit.
std::optional<double> meanRadiosity(const Scene& scene, const Discretization& discretization,
                                    const std::vector<glm::dvec3>& radiosity, bool withEmitters) {
  double flux = 0, totalArea = 0;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    if (!withEmitters && !isZero(emission(scene, discretization, e))) continue;
    const glm::dvec3& b = radiosity[e];
    flux += discretization.elements[e].area * (bandSum(b) / 3);
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
  return fillTextures(discretization, layout, 1, [&](std::uint32_t surface) {
    return unfilteredTexels(discretization.grids[surface], radiosity);
  });
}

std::vector<Image> filteredTextures(const Scene& scene, const Discretization& discretization,
                                    const TextureLayout& layout, const std::vector<glm::dvec3>& radiosity,
                                    const TextureSettings& settings) {
  assert(settings.magnification >= 1 && settings.magnification <= maxMagnification);
  return fillTextures(discretization, layout, settings.magnification, [&](std::uint32_t surface) {
    return filteredTexels(scene, discretization, surface, radiosity, settings);
  });
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
