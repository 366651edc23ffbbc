/// Material maps averaged over elements: the exact integral of an image, taken as constant over each of its pixels,
/// over the surface inside an element. So a light painted into a few pixels keeps its flux at every discretization.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The mean of `image` over each of the grid's elements, weighted by area; texture coordinates wrap. Where the surface
/// shows more than 2^24 pixels, as tiled images do, the image is first halved until it does not: the integral over
/// whole tiles stays what it was, and what lies within one reduced pixel of an element's border may count for its
/// neighbour.
std::vector<glm::dvec3> averageOverElements(const Image& image, const Surface& surface, const Grid& grid);

/// The image at half its width and height, rounded up: each pixel is the mean of what it covers.
Image halved(const Image& image);

}  // namespace hemitex::radiosity
