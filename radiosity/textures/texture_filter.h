/// Reconstruction filters: from one radiosity per element to the texels of a radiosity texture, which may be magnified
/// by an integer factor (Nielsen and Christensen 2002, section 3.3; Bastos, Goslin and Zhang 1997).
///
/// Let the centres of grid texels be integers. Then a texel of the texture lies at x = (i + 1/2) / magnification - 1/2.
/// Its value is the sum of w(x - k) w(y - l) b(k, l) over the grid texels with area, divided by the sum of weights.
/// Texels without area or beyond the chart are ignored. Weights are not negative, so that values stay within the range
/// of their neighbours and constants are reproduced. Away from edges all filters except one-to-one also reproduce
/// linear fields.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

enum class TextureFilter {
  OneToOne,  ///< w(t) = 1 for |t| < 1/2: the element of the texel
  Triangle,  ///< w(t) = (2 - |t|) / 4 for |t| < 2: (1 2 1) / 4 on texels
  Bilinear,  ///< w(t) = 1 - |t| for |t| < 1: between the centres of texels
  Bicubic,   ///< the cubic B-spline (Hou and Andrews 1978): twice continuously differentiable, (1 4 1) / 6 on texels
  Quadtree,  ///< corner values of leaves, see quadtree_texture.h; without a quadtree each texel is a leaf
  Gouraud,   ///< elements as Gouraud shaded polygons, see gouraud_texture.h
};

/// The weight of a texel at a distance in grid texels, for all filters except Quadtree and Gouraud.
double kernelWeight(TextureFilter filter, double distance);

/// False for Quadtree and Gouraud.
bool hasKernel(TextureFilter filter);

/// The value at a place of the chart, in texels from its corner, for filters with a kernel. Where only texels without
/// area weigh, the value of the element that the place belongs to.
glm::dvec3 filteredValue(const Grid& grid, const std::vector<glm::dvec3>& radiosity, TextureFilter filter,
                         const glm::dvec2& place);

/// One value per texel of a surface's texture, row by row, (columns * magnification) x (rows * magnification) values,
/// from one value per element. A grid texel without area has the value of its element's own texel. `magnification` is
/// the number of texels of the texture along the side of a grid texel, at least 1.
std::vector<glm::dvec3> filteredTexels(const Scene& scene, const Discretization& discretization, std::uint32_t surface,
                                       const std::vector<glm::dvec3>& radiosity, TextureFilter filter,
                                       int magnification);

}  // namespace hemitex::radiosity
