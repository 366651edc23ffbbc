/// The profile of a device as one HTML page that needs no other file, for its author to publish.
#pragma once

#include <span>
#include <string>

#include "reference/conformance/calibration/calibration.h"

namespace hemitex::cli {

struct ProfilePage {
  std::string device;  ///< its name
  const reference::ProbingSet& probes;
  std::span<const raster::ItemBuffer> answers;  ///< as calibrate takes them
  const reference::Calibration& calibration;
};

/// A table of the profile, and a picture per property from the answers to its probes: sub-pixel grid, edge rule, texel
/// addressing, depth, and the planes at which the device clips.
std::string toHtml(const ProfilePage& page);

}  // namespace hemitex::cli
