/// Averages material maps over elements: the exact integral of an image with constant pixels over the surface inside
/// each element. So a light painted into a few pixels keeps its flux in all discretizations.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A mapped reflectance of 1 or more is lowered to this value, so that light is absorbed eventually.
inline constexpr double maxMappedReflectance = 0.9999;

/// The mean of a map of each surface's material over each element of its grid, weighted by area; without a map 1. The
/// map of the reflectance is multiplied by the colours of the corners. If the surface shows more than 2^24 pixels, as
/// with tiled images, the image is halved until it does not. Halving keeps the integral over whole tiles. Light within
/// one reduced pixel of an element's border may count for the neighbour.
///
/// One list per surface. Cards share theirs: parallelograms whose charts are the whole square, with the same image,
/// texture coordinates (see textureMap) and grid.
std::vector<std::vector<glm::dvec3>> meansOfMap(const Scene& scene, std::span<const Grid> grids,
                                                std::optional<int> Material::*map);

/// The image at half its width and height, rounded up; each pixel is the mean of the pixels that it covers.
Image halved(const Image& image);

}  // namespace hemitex::radiosity
