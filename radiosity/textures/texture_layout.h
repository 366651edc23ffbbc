/// The places of surfaces in textures, and how many texels a display texture has per texel of the grid.
///
/// The radiosity texture (one texel per texel of the grid) and the display texture of a surface have the same layout,
/// magnified in the display texture, so that both have the same texture coordinates.
///
/// The magnification of a surface is by default the smallest power of two that gives its display texture at least 128
/// texels along the longer side. Then it looks smooth in viewers that do not filter. A surface of one texel, which may
/// be Gouraud shaded (see makeLitScene), gets 4 x 4 texels, or about 8 per triangle where there are many. A surface
/// with maps gets at least as many texels as it shows pixels of them, but at most 2048 along a side. While all display
/// textures together would have more than 2^26 texels, including borders and gaps, the largest magnification among all
/// surfaces is halved.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The number of texels around the place of a chart.
inline constexpr int textureBorder = 1;

/// The place of a surface's chart: texel (c, r) of its grid is pixel (column + c, row + r) of the texture, with row 0
/// at the BOTTOM of the picture (v = 0). The border lies around it. Charts are never rotated.
struct TexturePlace {
  int texture = 0;
  int column = 0;
  int row = 0;
};

/// The textures and the places of surfaces in them.
struct TextureLayout {
  struct Size {
    int width = 0, height = 0;  ///< in texels of the grid
    int magnification = 1;      ///< texels of the display texture along the side of a grid texel
  };
  std::vector<Size> textures;
  std::vector<std::string> names;    ///< one per texture, valid file names: that of the surface, or `radiosity-1`, ...
  std::vector<TexturePlace> places;  ///< one per surface
};

/// How display textures are magnified.
struct Magnification {
  std::optional<int> factor = {};               ///< of all surfaces; without it the rule above
  std::int64_t budget = std::int64_t{1} << 26;  ///< the maximum number of display texels by that rule
};

/// One texture per surface up to `separateLimit` surfaces. Above that surfaces of equal magnification share textures:
/// of at most 1024 x 1024 display texels, which are encoded in parallel. With a given factor or above the budget shared
/// textures have at most 4096 x 4096 texels of the grid. A surface that is larger, including its border, has a texture
/// of its own size.
TextureLayout layOutTextures(const Scene& scene, const Discretization& discretization,
                             const Magnification& magnification, std::size_t separateLimit = 64);

/// The number of texels of these display textures.
std::int64_t displayTexels(const std::vector<TextureLayout::Size>& textures);

/// Converts a chart coordinate of `surface`, in [0,1]^2, to a coordinate of its texture, in [0,1]^2 (v upwards).
glm::dvec2 textureCoordinate(const Discretization& discretization, const TextureLayout& layout, std::uint32_t surface,
                             const glm::dvec2& chart);

}  // namespace hemitex::radiosity
