/// Radiosity textures (Nielsen and Christensen 2002, section 3.3): writes a solution to images, with one texel per
/// element or filtered. Any viewer shows the lit scene by texture mapping with bilinear filtering.
///
/// Each chart has a border of one texel copied from its edge, and texels without area copy their nearest element. So
/// bilinear filtering adds no black. Above 64 surfaces the charts are packed into shared textures. A texture may be
/// magnified by an integer factor, including the border; texture coordinates stay the same.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/texture_filter.h"

namespace hemitex::radiosity {

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
    int width = 0, height = 0;
  };
  std::vector<Size> textures;
  std::vector<std::string> names;    ///< one per texture, valid file names: that of the surface, or `radiosity-1`, ...
  std::vector<TexturePlace> places;  ///< one per surface
};

/// One texture per surface up to `separateLimit` surfaces; above that, shared textures of at most 4096 x 4096. A
/// surface that is larger, including its border, has a texture of its own size.
TextureLayout layOutTextures(const Scene& scene, const Discretization& discretization, std::size_t separateLimit = 64);

/// Converts a chart coordinate of `surface`, in [0,1]^2, to a coordinate of its texture, in [0,1]^2 (v upwards).
glm::dvec2 textureCoordinate(const Discretization& discretization, const TextureLayout& layout, std::uint32_t surface,
                             const glm::dvec2& chart);

/// The radiosity of each element, one texel per element, in W/m^2.
std::vector<Image> radiosityTextures(const Discretization& discretization, const TextureLayout& layout,
                                     const std::vector<glm::dvec3>& radiosity);

/// As above with a filter and a magnification. Throws InputError if a texture would have more than 2^28 texels.
std::vector<Image> filteredTextures(const Scene& scene, const Discretization& discretization,
                                    const TextureLayout& layout, const std::vector<glm::dvec3>& radiosity,
                                    const TextureSettings& settings = {});

/// The displayed value per element: radiosity plus reflectance times the ambient estimate.
std::vector<glm::dvec3> displayRadiosity(const Scene& scene, const Discretization& discretization,
                                         const Solution& solution);

/// The factor that maps the area-weighted mean radiosity (bands averaged) of elements that do not emit to 0.18. If all
/// emit, uses the mean of all; returns 1 if that is zero.
double defaultExposure(const Scene& scene, const Discretization& discretization,
                       const std::vector<glm::dvec3>& radiosity);

}  // namespace hemitex::radiosity
