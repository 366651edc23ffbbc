/// What the raster rules demand at one pixel, spelled out: every triangle that covers its sample, from the visible one
/// backwards. It explains a word; item buffers are drawn by raster::SoftwareRenderer.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "raster/draw_list.h"
#include "raster/face.h"

namespace hemitex::reference {

struct Texel {
  int column = 0;
  int row = 0;
  bool operator==(const Texel&) const = default;
};

/// A triangle at the sample of a pixel. Depth and texture coordinates are rounded to binary64; their order and the
/// texel are exact.
struct Fragment {
  std::uint32_t triangle = 0;  ///< indices 3t to 3t + 2
  std::uint32_t draw = 0;
  bool facesAway = false;
  double w = 0;
  double u = 0, v = 0;
  std::optional<Texel> texel;  ///< none without an index map, or on a back
  raster::Word word = 0;
};

/// The fragments at pixel (column, row) of the viewport, nearest first, ties in draw order; none where the background
/// is. The list and the face are valid; the pixel lies in the scissor rectangle. The cost is that of every triangle.
std::vector<Fragment> fragmentsAt(const raster::DrawList& list, const raster::Face& face, int column, int row);

}  // namespace hemitex::reference
