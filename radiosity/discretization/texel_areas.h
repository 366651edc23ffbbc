/// How much of a surface is exposed in each texel of its grid: the exact areas that a discretization stores instead of
/// geometry.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// One entry a texel, columns * rows of them, row-major from row 0 at v = 0.
struct TexelAreas {
  std::vector<double> area;      ///< of the exposed surface inside the texel; they sum to its area
  std::vector<double> coverage;  ///< the exposed share of the texel's square, in [0, 1] but for rounding
  /// In Surface::triangles: the first that covers the texel's middle, else the one with the largest piece inside.
  std::vector<std::uint32_t> triangle;
};

TexelAreas texelAreas(const Surface& surface, const TexelGrid& grid);

}  // namespace hemitex::radiosity
