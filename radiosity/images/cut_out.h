/// A cut-out: the pixels of an image with alpha that are holes.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/images/image.h"

namespace hemitex::radiosity {

struct CutOut {
  int width = 0, height = 0;
  std::vector<bool> isHole;  ///< width * height, row-major; row 0 is the top
  Sampler sampler = {};
};

/// The cut-out of an image whose alpha times `factor` is below `cutoff` in holes. An image without alpha has alpha 1.
CutOut cutOutOf(const Image& image, double factor, double cutoff);

/// Whether the pixel at texture coordinates is a hole; v = 0 is the bottom.
bool isHoleAt(const CutOut& cutOut, const glm::dvec2& texcoord);

}  // namespace hemitex::radiosity
