/// Probe vectors: pictures in which each pixel tests one property of a device, so that the answers determine its
/// profile (calibration.h). A pixel's triangles stay within half a pixel of its sample and cover no other.
///
/// Corners lie at odd multiples of 2^-14 pixel. All snappings from 4 to 12 bits, rounded or truncated, change at even
/// multiples, which are at least 2^-14 pixel away. That is more than the error of the vertex stage in such a small
/// viewport. Probes of finer snappings have odd multiples of 2^-18 pixel, which are exact in binary32. Only a device
/// that computes them to less than that makes use of so many bits.
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

/// The sub-pixel bits of snappings that a probe is made for.
struct BitRange {
  int first, last;

  bool contains(int bits) const { return first <= bits && bits <= last; }
};

constexpr int exactBits = 18;  ///< those of the unit of corners, which stand for a device that does not snap
constexpr BitRange coarseBits{4, 12}, fineBits{13, exactBits};

/// Tests whether the sample is covered: item ID 1 means yes, the background no.
struct CoverageProbe {
  /// Corners of the triangle relative to the sample, in units of 2^-18 pixel.
  std::array<glm::ivec2, 3> corners;
  BitRange bits;
};

/// Tests which of two triangles covers a sample on the edge that they share: item ID 1 or 2. The triangle that is drawn
/// last is nearer, so that it shows where both cover the sample.
struct SharedEdgeProbe {
  std::array<CoverageProbe, 2> triangles;
};

/// Tests which side of the border between two texels is shown.
struct TexelProbe {
  raster::ItemId above;  ///< the item ID on the border and above it; the one below is one less
  double distance;       ///< of the coordinate from the border, in texels
  bool isAbove;          ///< whether `above` is right
  double rounding;       ///< the error of one rounding (device_profile.h, interpolationError), in texels
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
  /// One sheet for 4 to 12 bits, one up to 16, and one for devices that do not snap. Pixels 8 k to 8 k + 7 have the
  /// same two triangles, with both windings of each and both orders of drawing.
  std::vector<ProbeSheet<SharedEdgeProbe>> sharedEdges;
  std::vector<ProbeSheet<TexelProbe>> texels;         ///< roundings are small: they show errors of any other kind
  std::vector<ProbeSheet<TexelProbe>> interpolation;  ///< distances are some roundings, also of the product u N
  std::vector<ProbeSheet<DepthProbe>> depths;
  /// Triangles that reach beyond the view, and behind the near plane. Their answers show at which planes a device
  /// clips, but no profile follows from them.
  std::vector<TestVector> clipping;
};

/// Makes the same probes on all machines.
ProbingSet makeProbes();

/// All vectors of the set: those of coverage, shared edges, texels, interpolation, depths and clipping, in this order.
std::vector<TestVector> vectorsOf(const ProbingSet& probes);

}  // namespace hemitex::reference
