#include "radiosity/textures/texture_layout.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "radiosity/geometry/rectangle_packing.h"
#include "radiosity/textures/file_names.h"

namespace hemitex::radiosity {
namespace {

constexpr int border = 1;
constexpr int smoothSide = 128;
constexpr int largestTexture = 4096;
constexpr int largestDisplayTexture = 1024;

std::vector<RectangleSize> sizesWithBorders(const Discretization& discretization) {
  std::vector<RectangleSize> sizes;
  for (const Grid& grid : discretization.grids) sizes.push_back({grid.columns + 2 * border, grid.rows + 2 * border});
  return sizes;
}

int smoothMagnification(const Grid& grid) {
  if (grid.elementCount <= 1) return 1;
  int magnification = 1;
  while (magnification * std::max(grid.columns, grid.rows) < smoothSide) magnification *= 2;
  return magnification;
}

/// The number of display texels of a rectangle of grid texels.
std::int64_t magnifiedTexels(int width, int height, int magnification) {
  return std::int64_t{width} * height * magnification * magnification;
}

/// The number of display texels of all surfaces, without gaps between them.
std::int64_t magnifiedTexels(const std::vector<RectangleSize>& sizes, const std::vector<int>& magnifications) {
  std::int64_t texels = 0;
  for (std::size_t s = 0; s < sizes.size(); ++s)
    texels += magnifiedTexels(sizes[s].width, sizes[s].height, magnifications[s]);
  return texels;
}

TextureLayout separateTextures(const Scene& scene, const std::vector<RectangleSize>& sizes,
                               const std::vector<int>& magnifications) {
  TextureLayout layout;
  for (std::size_t surface = 0; surface < sizes.size(); ++surface) {
    layout.textures.push_back({sizes[surface].width, sizes[surface].height, magnifications[surface]});
    layout.names.push_back(scene.surfaces[surface].name);
    layout.places.push_back({static_cast<int>(surface), border, border});
  }
  layout.names = uniqueFileNames(layout.names, {"render"});  // render.png is in the same folder
  return layout;
}

/// Packs the surfaces of each magnification into textures of at most `largestSide(magnification)`.
template <typename LargestSide>
TextureLayout packTextures(const std::vector<RectangleSize>& sizes, const std::vector<int>& magnifications,
                           const LargestSide& largestSide) {
  TextureLayout layout;
  layout.places.resize(sizes.size());
  for (const int magnification : std::set<int>(magnifications.begin(), magnifications.end())) {
    std::vector<std::size_t> surfaces;
    std::vector<RectangleSize> own;
    for (std::size_t surface = 0; surface < sizes.size(); ++surface)
      if (magnifications[surface] == magnification) {
        surfaces.push_back(surface);
        own.push_back(sizes[surface]);
      }
    const Packing packing = packRectangles(own, largestSide(magnification));
    const auto first = static_cast<int>(layout.textures.size());
    for (const RectangleSize& page : packing.pages) layout.textures.push_back({page.width, page.height, magnification});
    for (std::size_t i = 0; i < own.size(); ++i) {
      const RectanglePlace& place = packing.places[i];
      layout.places[surfaces[i]] = {first + place.page, place.column + border, place.row + border};
    }
  }
  for (std::size_t t = 1; t <= layout.textures.size(); ++t) layout.names.push_back("radiosity-" + std::to_string(t));
  return layout;
}

/// Halves the largest magnification. Returns false if all are 1.
bool halveLargest(std::vector<int>& magnifications) {
  const int largest = magnifications.empty() ? 1 : *std::max_element(magnifications.begin(), magnifications.end());
  if (largest == 1) return false;
  std::replace(magnifications.begin(), magnifications.end(), largest, largest / 2);
  return true;
}

}  // namespace

TextureLayout layOutTextures(const Scene& scene, const Discretization& discretization,
                             const Magnification& magnification, std::size_t separateLimit) {
  assert(discretization.grids.size() == scene.surfaces.size());
  const std::vector<RectangleSize> sizes = sizesWithBorders(discretization);
  const auto layOut = [&](const std::vector<int>& magnifications, const auto& largestSide) {
    return sizes.size() <= separateLimit ? separateTextures(scene, sizes, magnifications)
                                         : packTextures(sizes, magnifications, largestSide);
  };
  if (magnification.factor)
    return layOut(std::vector<int>(sizes.size(), *magnification.factor), [](int) { return largestTexture; });

  std::vector<int> magnifications;
  for (const Grid& grid : discretization.grids) magnifications.push_back(smoothMagnification(grid));
  // Without packing first, which takes long for texels that are far too many.
  while (magnifiedTexels(sizes, magnifications) > magnification.budget && halveLargest(magnifications)) {
  }
  const bool isWithin = magnifiedTexels(sizes, magnifications) <= magnification.budget;
  const auto largestSide = [isWithin](int times) { return isWithin ? largestDisplayTexture / times : largestTexture; };
  while (true) {
    TextureLayout layout = layOut(magnifications, largestSide);
    if (displayTexels(layout) <= magnification.budget || !halveLargest(magnifications)) return layout;
  }
}

std::int64_t displayTexels(const TextureLayout& layout) {
  std::int64_t texels = 0;
  for (const TextureLayout::Size& size : layout.textures)
    texels += magnifiedTexels(size.width, size.height, size.magnification);
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
