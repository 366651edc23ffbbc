/// Radiosity at the corners of triangles, for Gouraud shading.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Radiosity at the corners of each triangle of the scene (in scene order), for Gouraud shading of surfaces that are
/// not discretized. It is the area-weighted mean over the triangles of such surfaces that share the position and the
/// material. Their normals must differ by less than 30 degrees. (Radiosity is discontinuous at the border of a
/// material.) Triangles of discretized surfaces have zeros. Takes linear time in the number of triangles, but quadratic
/// time in those around one position.
std::vector<std::array<glm::dvec3, 3>> cornerRadiosity(const Scene& scene, const Discretization& discretization,
                                                       const std::vector<glm::dvec3>& radiosity);

}  // namespace hemitex::radiosity
