/// What a depth test keeps: the farther of two fragments, and the last one of equal depths.
#pragma once

#include "raster/interface/draw_list.h"

namespace hemitex::raster {

inline bool keepsFarther(DepthTest test) { return test == DepthTest::Farther || test == DepthTest::FartherOrEqual; }

inline bool keepsLast(DepthTest test) { return test == DepthTest::NearerOrEqual || test == DepthTest::FartherOrEqual; }

}  // namespace hemitex::raster
