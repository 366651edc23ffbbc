/// Radiosity textures (Nielsen and Christensen 2002, section 3.3): writes a solution to images, with one texel per
/// element or filtered. Any viewer shows the lit scene by texture mapping with bilinear filtering.
///
/// Each chart has a border of one texel copied from its edge, and texels without area copy their nearest element. So
/// bilinear filtering adds no black.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/textures/chart_borders.h"
#include "radiosity/textures/map_texels.h"
#include "radiosity/textures/texture_filter.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::radiosity {

struct Solution;

/// The values of the texels of a surface's display texture, row by row.
using TexelsOfSurface = std::function<std::vector<glm::dvec3>(std::uint32_t surface)>;
/// All display textures of a layout, with their borders. May call texelsOf from several threads at a time. Throws
/// InputError as filteredTexture.
std::vector<Image> texturesOf(const Discretization& discretization, const TextureLayout& layout,
                              const TexelsOfSurface& texelsOf);

/// The radiosity of each element, one texel per element, in W/m^2.
std::vector<Image> radiosityTextures(const Discretization& discretization, const TextureLayout& layout,
                                     const std::vector<glm::dvec3>& radiosity);

/// Display texture t of the layout: filtered and magnified, including the border, from one value per element (see
/// displayValues). `borders` are the border edges of all surfaces (see chart_borders.h), and `maps` the levels of their
/// maps (see map_texels.h); without them nothing is corrected, and no map applied. Throws InputError if it would have
/// more than 2^28 texels.
Image filteredTexture(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                      std::size_t texture, const std::vector<glm::dvec3>& radiosity, TextureFilter filter,
                      const std::vector<std::vector<BorderEdge>>& borders = {},
                      const std::vector<ImageLevels>* maps = nullptr);

/// The displayed value of an element in W/m^2: radiosity plus reflectance times the ambient estimate.
glm::dvec3 displayRadiosity(const Scene& scene, const Discretization& discretization, const Solution& solution,
                            std::uint32_t element);
/// As above, of all elements.
std::vector<glm::dvec3> displayRadiosity(const Scene& scene, const Discretization& discretization,
                                         const Solution& solution);

/// One value per element for display textures, in W/m^2: the displayed radiosity; on surfaces with maps the irradiance
/// plus the ambient estimate, to which the texture applies the maps.
std::vector<glm::dvec3> displayValues(const Scene& scene, const Discretization& discretization,
                                      const Solution& solution);

}  // namespace hemitex::radiosity
