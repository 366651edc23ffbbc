/// The fragments at one pixel by the raster rules: every triangle that covers its sample and has no hole there, from
/// the visible one backwards. They explain an item ID; raster::SoftwareRenderer draws whole item buffers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "raster/plain/rules.h"

namespace hemitex::reference {

using raster::Texel;

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
  raster::SnappedTriangle screen = {};  ///< the covering part of the triangle after clipping
};

/// A triangle of a draw.
struct DrawnTriangle {
  std::uint32_t draw = 0;
  std::uint32_t triangle = 0;
};

/// Every triangle of every draw, in draw order.
std::vector<DrawnTriangle> drawnTriangles(const raster::DrawList& list);

/// Numbers of a sample that a triangle covers.
Fragment fragmentOf(const raster::DrawList& list, const raster::CoveredSample& sample);

/// The fragments at pixel (column, row) of the viewport; none at a background pixel. The visible one comes first, then
/// the one that would be visible without it, and so on: nearest first, ties in draw order, unless the list has another
/// depth test.
/// `triangles` are those of the face (raster::snappedTriangles).
std::vector<Fragment> fragmentsAt(const raster::DrawList& list, std::span<const raster::SnappedTriangle> triangles,
                                  int column, int row);

}  // namespace hemitex::reference
