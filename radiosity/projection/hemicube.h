/// The hemicube (Cohen and Greenberg 1985): half a cube over a point. It sees the whole half space. Its pixels have the
/// smallest solid angles near the edges between faces, where the picture plane is farthest away.
#pragma once

#include <vector>

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {

/// Squared reach of a hemicube, given by its corners (see Projection::squaredReach).
inline constexpr double hemicubeSquaredReach = 3;

/// The top, then the sides that look along the top's +x, +y, -x and -y; their rows grow away from the horizon. All
/// determinants are 1. The top has resolution x resolution pixels, a side the upper half of that. `resolution` is even,
/// 2 to 4096.
std::vector<ProjectionFace> hemicubeFaces(int resolution);

/// These faces with their delta form factors, the integrals over the solid angle of each pixel, rounded so that they
/// sum to exactly 2^60.
Projection hemicube(int resolution);

}  // namespace hemitex::radiosity
