/// Affine maps from the charts of surfaces to texture coordinates and to space. A card keeps its maps when a contact
/// divides its triangles, so that cards with equal maps can share what is computed of their images.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"
#include "raster/base/cross.h"

namespace hemitex::radiosity {

/// The affine map of a plane that takes three points, which do not lie on a line, to three others.
template <typename Point>
struct AffineMap {
  Point alongU, alongV, origin;

  AffineMap(const std::array<glm::dvec2, 3>& from, const std::array<Point, 3>& to) {
    const glm::dvec2 a = from[1] - from[0], b = from[2] - from[0];
    const Point p = to[1] - to[0], q = to[2] - to[0];
    const double determinant = raster::cross(a, b);
    alongU = (b.y * p - a.y * q) / determinant;
    alongV = (a.x * q - b.x * p) / determinant;
    origin = to[0] - from[0].x * alongU - from[0].y * alongV;
  }
  Point operator()(const glm::dvec2& point) const { return origin + point.x * alongU + point.y * alongV; }
};

/// The map from the chart to the texture coordinates of all triangles, rounded to multiples of 2^-20, so that equal
/// cards have equal maps. Nothing if it is off by more than 1/64 pixel at a corner, in an image of this size.
std::optional<AffineMap<glm::dvec2>> textureMap(const Surface& surface, const Sampler& sampler, const glm::dvec2& size);

/// Whether a surface is a parallelogram with the whole square as its chart, within the rounding of six decimals.
bool isWholeParallelogram(const Surface& surface);

}  // namespace hemitex::radiosity
