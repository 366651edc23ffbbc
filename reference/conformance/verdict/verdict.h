/// The verdict on the item buffers of a device. A pixel is *exact* if it holds the item ID of the raster rules. Any
/// other pixel is *explained* if a device within its profile may show the item ID, and an *error* otherwise. Item IDs
/// are compared as integers: an item ID that is off by one names another element.
///
/// A triangle that may cover the sample (triangle_bounds.h) explains the item IDs that it may produce. Its depth must
/// be able to pass the depth test against all guaranteed coverage of the sample. The background is explained without
/// guaranteed coverage. A triangle that a device may cull, or whose texel may be a hole, guarantees none.
/// Counts of samples that passed are not explained. Each bound is a worst case, so a device within the profile has no
/// errors.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/device_profile.h"
#include "reference/conformance/verdict/pixel_judge.h"

namespace hemitex::reference {

struct FaceVerdict {
  std::string name;
  raster::Scissor scissor;
  raster::ItemBuffer expected, found;
  std::vector<PixelVerdict> pixels;  ///< one per pixel of the scissor rectangle, row-major
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
