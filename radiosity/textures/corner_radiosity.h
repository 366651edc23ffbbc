/// Radiosity at the corners of triangles, for Gouraud shading.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Radiosity at the corners of every triangle of the scene (in scene order) for Gouraud shading surfaces that are not
/// discretized: the area-weighted mean over the triangles of such surfaces that share the position and the material
/// (radiosity jumps where a material ends) and whose normals differ by less than 30 degrees. Triangles of discretized
/// surfaces hold zeros. The cost is linear in the triangles, but quadratic in those around one position.
std::vector<std::array<glm::dvec3, 3>> cornerRadiosity(const Scene& scene, const Discretization& discretization,
                                                       const std::vector<glm::dvec3>& radiosity);

}  // namespace hemitex::radiosity
