/// A wall for which floating point cannot select texels: every sample lies on the borders of four texels.
#pragma once

#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::tests {

/// The wall of the vector borders-on-samples (suite_texels.cpp), parallel to the face frontFace(resolution, 0.5), with
/// one texel per pixel. It is moved to the right and down by `moved` pixels; moved by a third of a pixel, no sample
/// lies on a border. `resolution` must be a power of two.
inline raster::DrawList tiedWall(int resolution, double moved) {
  raster::DrawList list = reference::plainList();
  list.indexMaps.push_back(reference::countingMap(resolution, resolution));
  reference::addDraw(list, 0x10000, {}, 0);
  const auto corner = [&](double x, double y) { return reference::Picture(resolution).point({x, y}); };
  const double first = moved, end = resolution + moved;
  const glm::vec3 a = corner(first, first), b = corner(end, first), c = corner(end, end), d = corner(first, end);
  const float low = -0.5f / static_cast<float>(resolution), high = 1 + low;
  reference::addTriangle(list, {a, c, b}, {{low, low}, {high, high}, {high, low}});
  reference::addTriangle(list, {a, d, c}, {{low, low}, {low, high}, {high, high}});
  return list;
}

}  // namespace hemitex::tests
