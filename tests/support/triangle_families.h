/// Families of random triangles for typical rasterizer faults: slivers, samples on edges and corners, texel borders on
/// samples, clipping, extreme perspective, coplanar overlaps, coordinates far from zero.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/support/raster_scenes.h"

namespace hemitex::tests {

/// One case: a few triangles and the face that draws them.
struct DrawnCase {
  raster::DrawList list;
  raster::Face face;
};

struct TriangleFamily {
  std::string name;
  std::function<DrawnCase(std::mt19937&)> make;
  int trianglesPerCase;
};

std::vector<TriangleFamily> triangleFamilies();

}  // namespace hemitex::tests
