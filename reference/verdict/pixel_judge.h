/// One pixel judged: which words may a device show there?
#pragma once

#include <span>

#include "reference/verdict/triangle_bounds.h"
#include "reference/verdict/verdict.h"

namespace hemitex::reference {

/// What every pixel of a face is judged by.
struct Judge {
  const raster::DrawList& list;
  const DeviceProfile& profile;
  double depthTolerance;  ///< of 1/w, between two triangles
  double nearest;         ///< 1/w at the near plane
};

Judge makeJudge(const raster::DrawList& list, const raster::Face& face, const DeviceProfile& profile);

/// Coverage, Texel, Depth or Error for a word that is not the rules' at a sample. `triangles` holds all that may cover
/// the sample, and may hold others.
PixelVerdict judgeWord(const Judge& judge, std::span<const DeviceTriangle* const> triangles, const glm::dvec2& sample,
                       raster::Word found);

}  // namespace hemitex::reference
