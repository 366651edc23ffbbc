/// Material maps at the resolution of display textures.
///
/// An element has the mean of a map over its area, so that elements larger than the pattern of a map do not show it. A
/// display texture shows the pattern: it holds emission + reflectance x irradiance, where the irradiance is filtered
/// from elements, and emission and reflectance are those of the map at each texel.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The number of pixels of the maps and the cut-out of a surface along u and v of its chart, the largest one if it has
/// several; 0 without maps. Repeated pixels count as often as the surface shows them.
glm::dvec2 mapPixels(const Scene& scene, const Surface& surface);

/// An image, and the same image halved, halved again, ... down to one pixel (Williams 1983).
using ImageLevels = std::vector<Image>;
/// The levels of each image of the scene that a surface shows; none for the others.
std::vector<ImageLevels> levelsOfMaps(const Scene& scene);

/// Lights the texels of a surface with maps: replaces each irradiance by emission + reflectance x irradiance. `texels`
/// are columns x rows values in W/m^2 over the chart, row by row from v = 0. The value of a map is the mean of the
/// pixels at 2 x 2 places of a texel, in the level with one or two pixels per texel, if it has as many. A texel that no
/// triangle covers has the material of the nearest texel that one covers.
void applyMaps(const Scene& scene, const std::vector<ImageLevels>& levels, const Surface& surface, int columns,
               int rows, std::vector<glm::dvec3>& texels);

}  // namespace hemitex::radiosity
