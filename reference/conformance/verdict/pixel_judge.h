/// Judges one pixel: which item IDs may a device show there?
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/conformance/vectors/enum_names.h"
#include "reference/conformance/verdict/device_profile.h"
#include "reference/conformance/verdict/triangle_bounds.h"

namespace hemitex::reference {

enum class PixelVerdict : std::uint8_t {
  Exact,
  Coverage,       ///< explained: another triangle covers the sample, or none
  Texel,          ///< explained: the rules' triangle, at a nearby texel
  Depth,          ///< explained: another triangle that covers the sample passes the depth test
  LooseClipping,  ///< explained only by clipping at other planes
  Error,
};

/// In the order of the enum.
constexpr std::array<Named<PixelVerdict>, 6> pixelVerdictNames{{{PixelVerdict::Exact, "exact"},
                                                                {PixelVerdict::Coverage, "coverage"},
                                                                {PixelVerdict::Texel, "texel"},
                                                                {PixelVerdict::Depth, "depth"},
                                                                {PixelVerdict::LooseClipping, "loose-clipping"},
                                                                {PixelVerdict::Error, "error"}}};

/// Input of the judgement that all pixels of a face share.
struct JudgedFace {
  const raster::DrawList& list;
  const DeviceProfile& profile;
  // Depths are -z/w, which is 1/w of a scene, with the other sign where the farther fragment passes. So larger ones
  // win.
  double depthTolerance;       ///< between two triangles
  double nearest;              ///< 1/w at the near plane of a scene
  double cleared;              ///< may be stored as the cleared depth, whose fragments the background hides
  std::vector<char> hasHoles;  ///< one per index map
};

JudgedFace judgedFace(const raster::DrawList& list, const raster::Face& face, const DeviceProfile& profile);

/// Coverage, Texel, Depth or Error for an item ID that differs from the rules' at a sample. `triangles` holds at least
/// all triangles that may cover the sample, in draw order.
PixelVerdict judgeId(const JudgedFace& face, std::span<const DeviceTriangle* const> triangles,
                     const raster::SnappedPoint& sample, raster::ItemId found);

}  // namespace hemitex::reference
