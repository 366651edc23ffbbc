/// Probing vectors: pictures in which every pixel asks a device one question, so that its answers tell its profile
/// (calibration.h). A pixel's triangles stay within half a pixel of its sample and cover no other.
///
/// Corners stand at odd multiples of 1/16384 pixel. All snapping from 4 to 12 bits, rounded or truncated, changes at
/// even ones: at least 1/16384 pixel away, which is more than the vertex stage errs in so small a viewport.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "reference/vectors/vector_file.h"

namespace hemitex::reference {

/// A picture of probes: a vector of one face, and what each of its pixels asks, row by row.
template <typename Probe>
struct ProbeSheet {
  TestVector vector;
  std::vector<Probe> pixels;
};

/// Is the sample covered? Item ID 1 says yes, the background no.
struct CoverageProbe {
  /// Corners of the triangle relative to the sample, in units of 1/16384 pixel.
  std::array<glm::ivec2, 3> corners;
};

/// Which side of the border between texels `border - 1` and `border` is shown? The item ID is the texel.
struct TexelProbe {
  int border;
  double distance;  ///< of the coordinate from the border, in texels
  bool isAbove;     ///< whether texel `border` is right
};

/// How close two depths are: a difference that devices of a format tell apart for certain, or one that needs a float32
/// buffer close to 0.
enum class DepthStep { Unorm16, Float32, Unorm24, Fine };

/// Which of two triangles is nearer? Item IDs are 1 for the first that is drawn and 2 for the second.
struct DepthProbe {
  DepthStep step;
  raster::ItemId nearer;
};

struct ProbingSet {
  std::vector<ProbeSheet<CoverageProbe>> coverage;
  std::vector<ProbeSheet<TexelProbe>> texels;
  std::vector<ProbeSheet<DepthProbe>> depths;
};

/// The same on every machine.
ProbingSet makeProbes();

/// All vectors of the set: those of coverage, texels and depths, in this order.
std::vector<TestVector> vectorsOf(const ProbingSet& probes);

}  // namespace hemitex::reference
