/// What finer elements cost: the same hemicubes of a scene whose surfaces have more and more elements.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "reference/bench/timing.h"

namespace hemitex::reference {

struct GrowthPoint {
  int side = 0;  ///< elements along the side of every surface
  std::size_t elements = 0;
  Timing draw, row;  ///< of a hemicube: faces drawn and item IDs resolved; their row summed
};

/// Of a scene whose surfaces have sides[i] x sides[i] elements each, in interleaved repetitions. Item IDs have 32 bits.
std::vector<GrowthPoint> growthOf(const radiosity::Scene& scene, std::span<const int> sides, int resolution,
                                  int repeats);

}  // namespace hemitex::reference
