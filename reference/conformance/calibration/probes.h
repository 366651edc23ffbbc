/// Probe vectors: pictures in which each pixel tests one property of a device, so that the answers determine its
/// profile (calibration.h). A pixel's triangles stay within half a pixel of its sample and cover no other.
///
/// Corners lie at odd multiples of 1/16384 pixel. All snappings from 4 to 12 bits, rounded or truncated, change at even
/// multiples, which are at least 1/16384 pixel away. That is more than the error of the vertex stage in such a small
/// viewport.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// A picture of probes: a vector of one face, and the probe of each pixel, row by row.
template <typename Probe>
struct ProbeSheet {
  TestVector vector;
  std::vector<Probe> pixels;
};

/// Tests whether the sample is covered: item ID 1 means yes, the background no.
struct CoverageProbe {
  /// Corners of the triangle relative to the sample, in units of 1/16384 pixel.
  std::array<glm::ivec2, 3> corners;
};

/// Tests which side of the border between texels `border - 1` and `border` is shown. The item ID is the texel.
struct TexelProbe {
  int border;
  double distance;  ///< of the coordinate from the border, in texels
  bool isAbove;     ///< whether texel `border` is right
  double rounding;  ///< the error of one rounding (device_profile.h, interpolationError), in texels
};

/// The difference of two depths: one that devices of a format must resolve, or one that needs a float32 buffer close to
/// 0.
enum class DepthStep { Unorm16, Float32, Unorm24, Fine };

/// Tests which of two triangles is nearer. Item IDs are 1 for the first that is drawn and 2 for the second.
struct DepthProbe {
  DepthStep step;
  raster::ItemId nearer;
};

struct ProbingSet {
  std::vector<ProbeSheet<CoverageProbe>> coverage;
  std::vector<ProbeSheet<TexelProbe>> texels;         ///< roundings are small: they show errors of any other kind
  std::vector<ProbeSheet<TexelProbe>> interpolation;  ///< distances are some roundings
  std::vector<ProbeSheet<DepthProbe>> depths;
};

/// Makes the same probes on all machines.
ProbingSet makeProbes();

/// All vectors of the set: those of coverage, texels, interpolation and depths, in this order.
std::vector<TestVector> vectorsOf(const ProbingSet& probes);

}  // namespace hemitex::reference
