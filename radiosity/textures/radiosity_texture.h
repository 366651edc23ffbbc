/// Radiosity textures (Nielsen and Christensen 2002, section 3.3): a solution copied into images, one texel an
/// element or filtered, so that any viewer shows the lit scene by texture mapping with bilinear filtering.
///
/// Every chart gets a border of one texel copied from its edge, and texels without area copy their nearest element,
/// so that bilinear filtering bleeds no black. Above 64 surfaces the charts are packed into shared textures. A texture
/// may be magnified by a whole factor, border and all: texture coordinates stay.
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

/// Where a surface's chart lies: texel (c, r) of its grid is pixel (column + c, row + r) of the texture, with row 0 at
/// the BOTTOM of the picture (v = 0); around it lies the border. A chart is never rotated.
struct TexturePlace {
  int texture = 0;
  int column = 0;
  int row = 0;
};

/// Which surface lies where in which texture.
struct TextureLayout {
  struct Size {
    int width = 0, height = 0;
  };
  std::vector<Size> textures;
  std::vector<std::string> names;    ///< one a texture, usable as a file name: the surface's, or `radiosity-1`, ...
  std::vector<TexturePlace> places;  ///< one a surface
};

/// One texture a surface up to `separateLimit` surfaces, shared textures of at most 4096 x 4096 above; a surface that
/// is larger, with its border, has one of its own size.
TextureLayout layOutTextures(const Scene& scene, const Discretization& discretization, std::size_t separateLimit = 64);

/// A coordinate of the chart of `surface`, in [0,1]^2, as a coordinate of its texture, in [0,1]^2 (v upwards).
glm::dvec2 textureCoordinate(const Discretization& discretization, const TextureLayout& layout, std::uint32_t surface,
                             const glm::dvec2& chart);

/// The radiosity of every element, one-to-one, in W/m^2.
std::vector<Image> radiosityTextures(const Discretization& discretization, const TextureLayout& layout,
                                     const std::vector<glm::dvec3>& radiosity);

/// The same reconstructed by a filter, as many times as wide and high as the layout as the settings say. Throws
/// InputError where a texture would have more than 2^28 texels.
std::vector<Image> filteredTextures(const Scene& scene, const Discretization& discretization,
                                    const TextureLayout& layout, const std::vector<glm::dvec3>& radiosity,
                                    const TextureSettings& settings = {});

/// What is displayed: radiosity plus reflectance times the ambient estimate, one an element.
std::vector<glm::dvec3> displayRadiosity(const Scene& scene, const Discretization& discretization,
                                         const Solution& solution);

/// The factor that shows the area-weighted mean radiosity (bands averaged) of what does not emit as 0.18; where all
/// emits, that of everything; 1 where that is zero.
double defaultExposure(const Scene& scene, const Discretization& discretization,
                       const std::vector<glm::dvec3>& radiosity);

}  // namespace hemitex::radiosity
