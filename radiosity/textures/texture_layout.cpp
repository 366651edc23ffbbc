#include "radiosity/textures/texture_layout.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "radiosity/geometry/rectangle_packing.h"
#include "radiosity/textures/file_names.h"
#include "radiosity/textures/map_texels.h"

namespace hemitex::radiosity {
namespace {

constexpr int smoothSide = 128;
constexpr int largestDetail = 2048;
constexpr int largestTexture = 4096;
constexpr int largestDisplayTexture = 1024;

using Size = TextureLayout::Size;

/// A surface of one element may be Gouraud shaded: then its texture has some texels per triangle.
int gouraudMagnification(std::size_t triangles) {
  int magnification = 4;
  while (magnification < smoothSide &&
         static_cast<std::size_t>(magnification) * static_cast<std::size_t>(magnification) < 8 * triangles)
    magnification *= 2;
  return magnification;
}

int smoothMagnification(const Grid& grid, std::size_t triangles) {
  if (!isDiscretized(grid)) return gouraudMagnification(triangles);
  if (grid.elementCount <= 1) return 1;
  int magnification = 1;
  while (magnification * std::max(grid.columns, grid.rows) < smoothSide) magnification *= 2;
  return magnification;
}

/// The smallest power of two that gives the display texture as many texels as the surface shows pixels of its maps.
int detailMagnification(const Grid& grid, const glm::dvec2& pixels) {
  int magnification = 1;
  while ((magnification * grid.columns < pixels.x || magnification * grid.rows < pixels.y) &&
         2 * magnification * std::max(grid.columns, grid.rows) <= largestDetail)
    magnification *= 2;
  return magnification;
}

/// `sizes` are those of the surfaces with their borders.
TextureLayout separateTextures(const Scene& scene, const std::vector<Size>& sizes) {
  TextureLayout layout{sizes, {}, {}};
  for (std::size_t surface = 0; surface < sizes.size(); ++surface) {
    layout.names.push_back(scene.surfaces[surface].name);
    layout.places.push_back({static_cast<int>(surface), textureBorder, textureBorder});
  }
  layout.names = uniqueFileNames(layout.names, {"render"});  // render.png is in the same folder
  return layout;
}

/// Packs the surfaces of each magnification into textures of at most `largestSide(magnification)`.
template <typename LargestSide>
TextureLayout packTextures(const std::vector<Size>& sizes, const LargestSide& largestSide) {
  TextureLayout layout;
  layout.places.resize(sizes.size());
  std::set<int> magnifications;
  for (const Size& size : sizes) magnifications.insert(size.magnification);
  for (const int magnification : magnifications) {
    std::vector<std::size_t> surfaces;
    std::vector<RectangleSize> own;
    for (std::size_t surface = 0; surface < sizes.size(); ++surface)
      if (sizes[surface].magnification == magnification) {
        surfaces.push_back(surface);
        own.push_back({sizes[surface].width, sizes[surface].height});
      }
    const Packing packing = packRectangles(own, largestSide(magnification));
    const auto first = static_cast<int>(layout.textures.size());
    for (const RectangleSize& page : packing.pages) layout.textures.push_back({page.width, page.height, magnification});
    for (std::size_t i = 0; i < own.size(); ++i) {
      const RectanglePlace& place = packing.places[i];
      layout.places[surfaces[i]] = {first + place.page, place.column + textureBorder, place.row + textureBorder};
    }
  }
  for (std::size_t t = 1; t <= layout.textures.size(); ++t) layout.names.push_back("radiosity-" + std::to_string(t));
  return layout;
}

/// Halves the largest magnification. Returns false if all are 1.
bool halveLargest(std::vector<Size>& sizes) {
  int largest = 1;
  for (const Size& size : sizes) largest = std::max(largest, size.magnification);
  if (largest == 1) return false;
  for (Size& size : sizes)
    if (size.magnification == largest) size.magnification /= 2;
  return true;
}

}  // namespace

TextureLayout layOutTextures(const Scene& scene, const Discretization& discretization,
                             const Magnification& magnification, std::size_t separateLimit) {
  assert(discretization.grids.size() == scene.surfaces.size());
  std::vector<Size> sizes;
  for (std::size_t s = 0; s < discretization.grids.size(); ++s) {
    const Grid& grid = discretization.grids[s];
    const int smooth = std::max(smoothMagnification(grid, scene.surfaces[s].triangles.size()),
                                detailMagnification(grid, mapPixels(scene, scene.surfaces[s])));
    sizes.push_back(
        {grid.columns + 2 * textureBorder, grid.rows + 2 * textureBorder, magnification.factor.value_or(smooth)});
  }
  const auto layOut = [&](const auto& largestSide) {
    return sizes.size() <= separateLimit ? separateTextures(scene, sizes) : packTextures(sizes, largestSide);
  };
  if (magnification.factor) return layOut([](int) { return largestTexture; });

  // Without packing first, which takes long for texels that are far too many.
  while (displayTexels(sizes) > magnification.budget && halveLargest(sizes)) {
  }
  const bool isWithin = displayTexels(sizes) <= magnification.budget;
  const auto largestSide = [isWithin](int times) { return isWithin ? largestDisplayTexture / times : largestTexture; };
  while (true) {
    TextureLayout layout = layOut(largestSide);
    if (displayTexels(layout.textures) <= magnification.budget || !halveLargest(sizes)) return layout;
  }
}

std::int64_t displayTexels(const std::vector<TextureLayout::Size>& textures) {
  std::int64_t texels = 0;
  for (const Size& size : textures)
    texels += std::int64_t{size.width} * size.height * size.magnification * size.magnification;
  return texels;
}

glm::dvec2 textureCoordinate(const Discretization& discretization, const TextureLayout& layout, std::uint32_t surface,
                             const glm::dvec2& chart) {
  const Grid& grid = discretization.grids[surface];
  const TexturePlace& place = layout.places[surface];
  const TextureLayout::Size& size = layout.textures[static_cast<std::size_t>(place.texture)];
  return {(place.column + chart.x * grid.columns) / size.width, (place.row + chart.y * grid.rows) / size.height};
}

}  // namespace hemitex::radiosity
