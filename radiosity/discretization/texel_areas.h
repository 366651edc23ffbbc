/// The exposed area of a surface in each texel of its grid: the exact areas that a discretization stores instead of
/// geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// One entry per texel, columns * rows in total, row-major from row 0 at v = 0.
struct TexelAreas {
  std::vector<double> area;      ///< of the exposed surface inside the texel; their sum is its exposed area
  std::vector<double> coverage;  ///< exposed share of the texel's square, in [0, 1] except for rounding
  /// In Surface::triangles: the first triangle that covers the middle of the texel, else the one with the largest
  /// piece.
  std::vector<std::uint32_t> triangle;
};

TexelAreas texelAreas(const Surface& surface, const TexelGrid& grid);

}  // namespace hemitex::radiosity
