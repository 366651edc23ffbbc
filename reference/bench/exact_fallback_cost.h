/// A wall that floating point cannot decide: every sample lies on the borders of four texels. What exact arithmetic
/// costs there, beside the same wall where no sample lies on a border.
#pragma once

#include "raster/interface/draw_list.h"
#include "reference/bench/timing.h"

namespace hemitex::reference {

/// The wall of the vector borders-on-samples (suite_texels.cpp): seen straight on by frontFace(resolution, 0.5),
/// a texel a pixel, moved to the right and down by so many pixels. `resolution` is a power of two.
raster::DrawList tiedWall(int resolution, double moved);

struct WallTimes {
  int resolution = 0;
  Timing tied, moved;  ///< drawing the wall, and the same moved by a third of a pixel
};

WallTimes wallTimes(int resolution, int repeats);

}  // namespace hemitex::reference
