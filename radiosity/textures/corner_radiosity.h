/// Radiosity at the corners of triangles, for Gouraud shading.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::radiosity {

/// One value per corner of a triangle.
using CornerColours = std::array<glm::dvec3, 3>;

/// Radiosity at the corners of the triangles of each surface, from one value per element; empty lists for discretized
/// surfaces. It is the area-weighted mean over the triangles of surfaces that are not discretized and share the
/// position and the material. Their normals must differ by less than 30 degrees. (Radiosity is discontinuous at the
/// border of a material.) Takes n log n time for n triangles, but quadratic time in those around one position.
std::vector<std::vector<CornerColours>> cornerRadiosity(const Scene& scene, const Discretization& discretization,
                                                        const std::vector<glm::dvec3>& radiosity);

/// Draws the triangles of a surface, Gouraud shaded, into its place of its display texture, with the border. Each texel
/// within 1.5 texels of a triangle has the value at its centre. Outside of all triangles that is the linear
/// continuation of the nearest one. So bilinear interpolation gives each triangle its exact colours, except within a
/// texel of an edge where the gradients of two triangles differ.
void drawCorners(const Surface& surface, const std::vector<CornerColours>& corners, const TexturePlace& place,
                 const Grid& grid, int magnification, Image& texture);

}  // namespace hemitex::radiosity
