/// The two verdicts on a device's item buffers, which never blur: a pixel is *exact* where it holds the item ID of the
/// raster rules, and of the others it is *explained* where a device within its profile may show that item ID, an
/// *error* otherwise (raster rules, 8). Item IDs are compared as integers: an item ID that is off by one names another
/// element.
///
/// An item ID is explained when some triangle that may cover the sample (triangle_bounds.h) may give it, at a depth
/// that may pass the depth test against everything that covers the sample for certain; the background when nothing
/// does. Every bound is a worst case taken alone, so a device within the profile is never accused.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reference/vectors/vector_file.h"
#include "reference/verdict/device_profile.h"
#include "reference/verdict/pixel_judge.h"

namespace hemitex::reference {

struct FaceVerdict {
  std::string name;
  raster::Scissor scissor;
  raster::ItemBuffer expected, found;
  std::vector<PixelVerdict> pixels;  ///< one a pixel of the scissor rectangle, row-major
};

struct Verdict {
  std::string vector;  ///< its name
  std::vector<FaceVerdict> faces;
};

/// How many pixels have each verdict, by PixelVerdict.
using VerdictCounts = std::array<std::uint64_t, pixelVerdictNames.size()>;
VerdictCounts countVerdicts(const FaceVerdict& face);
/// Over all faces.
VerdictCounts countVerdicts(const Verdict& verdict);
bool hasErrors(const Verdict& verdict);

/// Judges `found` against `expected`: one item buffer per face each, in the order of faces and of the face's size.
Verdict judge(const TestVector& vector, std::span<const raster::ItemBuffer> expected,
              std::span<const raster::ItemBuffer> found, const DeviceProfile& profile);

/// The same against what the reference renderer draws.
Verdict judge(const TestVector& vector, std::span<const raster::ItemBuffer> found, const DeviceProfile& profile);

}  // namespace hemitex::reference
