/// The fragments at one pixel by the raster rules: every triangle that covers its sample, from the visible one
/// backwards. They explain an item ID; raster::SoftwareRenderer draws whole item buffers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::reference {

struct Texel {
  int column = 0;
  int row = 0;
  bool operator==(const Texel&) const = default;
};

/// A triangle at the sample of a pixel. Order and texel are exact. 1/w, u and v are rounded to binary64: the error of
/// 1/w is less than 2^-49 of itself, that of u and v less than 2^-49 of the largest coordinate at the vertices.
struct Fragment {
  std::uint32_t triangle = 0;  ///< indices 3t to 3t + 2
  std::uint32_t draw = 0;
  bool facesAway = false;
  double inverseDepth = 0;  ///< 1/w
  double u = 0, v = 0;
  std::optional<Texel> texel;  ///< none without an index map, or on a back
  raster::ItemId id = 0;
  raster::ScreenTriangle screen = {};  ///< the covering part of the triangle after clipping
};

/// A triangle of a draw.
struct DrawnTriangle {
  std::uint32_t draw = 0;
  std::uint32_t triangle = 0;
};

/// Every triangle of every draw, in draw order.
std::vector<DrawnTriangle> drawnTriangles(const raster::DrawList& list);

/// Sets up triangles on the screen of a face, given in draw order. The list and the face are valid. One setup serves
/// any number of pixels.
std::vector<raster::ScreenTriangle> screenTriangles(const raster::DrawList& list, const raster::Face& face,
                                                    std::span<const DrawnTriangle> drawn);
/// The same for the triangles of all draws.
std::vector<raster::ScreenTriangle> screenTriangles(const raster::DrawList& list, const raster::Face& face);

/// The fragments at pixel (column, row) of the viewport, nearest first, ties in draw order; none at a background pixel.
/// The pixel lies in the scissor rectangle.
std::vector<Fragment> fragmentsAt(const raster::DrawList& list, std::span<const raster::ScreenTriangle> triangles,
                                  int column, int row);

}  // namespace hemitex::reference
