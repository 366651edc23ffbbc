/// The share of a point's light through the pixels that a triangle covers, as if it were alone.
///
/// Beside the share through the pixels that show the triangle it gives the visible part: both have the same pixels, so
/// that their ratio has little aliasing.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "radiosity/projection/projection.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

/// The share, in [0, 1], of the light through all pixels whose centre the triangle covers; 0 if it shows its back.
/// `faces` are the faces of the projection over a point (see facesOver), `corners` are relative to the origin of the
/// scene. Double precision; corners are not snapped, so that pixels at edges may differ from drawn ones.
double coveredShare(const Projection& projection, std::span<const raster::Face> faces,
                    const std::array<glm::dvec3, 3>& corners);

}  // namespace hemitex::radiosity
