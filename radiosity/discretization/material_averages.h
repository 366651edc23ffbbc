/// Averages material maps over elements: the exact integral of an image with constant pixels over the surface inside
/// each element. So a light painted into a few pixels keeps its flux in all discretizations.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A mapped reflectance of 1 or more is lowered to this value, so that light is absorbed eventually.
inline constexpr double maxMappedReflectance = 0.9999;

/// The mean of `image` over each element of the grid, weighted by area; texture coordinates repeat. If the surface
/// shows more than 2^24 pixels, as with tiled images, the image is halved until it does not. Halving keeps the integral
/// over whole tiles. Light within one reduced pixel of an element's border may count for the neighbour.
std::vector<glm::dvec3> averageOverElements(const Image& image, const Surface& surface, const Grid& grid);

/// As above for a map of a surface's material, in Scene::images; without a map all means are 1.
std::vector<glm::dvec3> meansOfMap(const Scene& scene, const Surface& surface, const Grid& grid,
                                   const std::optional<int>& map);

/// The image at half its width and height, rounded up; each pixel is the mean of the pixels that it covers.
Image halved(const Image& image);

}  // namespace hemitex::radiosity
