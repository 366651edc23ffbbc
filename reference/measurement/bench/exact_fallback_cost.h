/// Measures the time of exact arithmetic. In the worst case every sample of a wall lies on the borders of four texels,
/// so that floating point cannot select a texel. The control is the same wall with no sample on a border.
#pragma once

#include "raster/interface/draw_list.h"
#include "reference/measurement/bench/timing.h"

namespace hemitex::reference {

/// The wall of the vector borders-on-samples (suite_texels.cpp), parallel to the face frontFace(resolution, 0.5), with
/// one texel per pixel. It is moved to the right and down by `moved` pixels. `resolution` must be a power of two.
raster::DrawList tiedWall(int resolution, double moved);

struct WallTimes {
  int resolution = 0;
  Timing tied, moved;  ///< worst case; control: moved by a third of a pixel
};

/// Measures both walls.
WallTimes wallTimes(int resolution, int repeats);

}  // namespace hemitex::reference
