/// Reconstruction filters: from one radiosity an element to the texels of a radiosity texture, which may be finer by a
/// whole factor (Nielsen and Christensen 2002, section 3.3; Bastos, Goslin and Zhang 1997).
///
/// A texel of the texture lies at x = (i + 1/2) / magnification - 1/2 in the texels of the grid, whose centres are the
/// whole numbers. Its value is the sum of w(x - k) w(y - l) b(k, l) over the texels that have area, over the sum of
/// their weights: what has no area and what lies beyond the chart take no part. No weight is below 0, so no value is
/// beyond those around it, and constants stay. Away from edges linear fields stay too, but for one-to-one.
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
  Bicubic,   ///< the cubic B-spline (Hou and Andrews 1978): smooth to the second derivative, (1 4 1) / 6 on texels
  Quadtree,  ///< corner values of leaves, see quadtree_texture.h; without a quadtree every texel is a leaf
  Gouraud,   ///< elements as Gouraud shaded polygons, see gouraud_texture.h
};

struct TextureSettings {
  TextureFilter filter = TextureFilter::Triangle;
  int magnification = 1;  ///< texels of the texture along the side of one of the grid; 1 to 16
};

inline constexpr int maxMagnification = 16;

/// The weight of a texel at a distance, for the filters that have a kernel: all but Quadtree and Gouraud.
double kernelWeight(TextureFilter filter, double distance);

/// A value a texel of the texture of one surface, row by row, (columns * magnification) x (rows * magnification) of
/// them, from one value an element. A texel of the grid without area shows its element as that one's own texel does.
std::vector<glm::dvec3> filteredTexels(const Scene& scene, const Discretization& discretization, std::uint32_t surface,
                                       const std::vector<glm::dvec3>& radiosity, const TextureSettings& settings);

}  // namespace hemitex::radiosity
