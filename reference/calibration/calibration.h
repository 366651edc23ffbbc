/// Calibration: the profile of a device (device_profile.h) from its answers to the probing vectors (probes.h).
///
/// - Snapping: each number of bits from 4 to 12, rounded or truncated, predicts which samples are covered; the device
///   does what contradicts none of its answers. Samples that a prediction puts on an edge tell the edge rule.
/// - Texels: a coordinate at some distance from a border that shows the texel beyond it is off by more than that
///   distance. The precision is twice the largest such distance: the device errs by more than half of it, and would
///   have erred at a larger one otherwise.
/// - Depth: the finest format that tells apart what it has to; of two formats that both do, float32 where depths close
///   to 0 are told apart that integers of 24 bits cannot hold.
///
/// What is not probed keeps the default: the errors of the vertex stage, the tolerance of depths, loose clipping.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "raster/interface/face.h"
#include "reference/calibration/probes.h"
#include "reference/verdict/device_profile.h"

namespace hemitex::reference {

struct Calibration {
  DeviceProfile profile;            ///< of meaning where there are no faults
  std::vector<std::string> faults;  ///< what no profile explains, a line each
};

/// `answers` holds an item buffer for each of vectorsOf(probes), in their order and of their size.
Calibration calibrate(const ProbingSet& probes, std::span<const raster::ItemBuffer> answers);

/// Whether a device of a snapping covers the sample of a probe.
enum class Coverage {
  Outside,
  Inside,
  OnIncludedEdge,  ///< on edges that are all top or left
  OnOtherEdge,     ///< on an edge that is neither
};
Coverage coverageOf(const CoverageProbe& probe, int subpixelBits, SnapRounding rounding);

}  // namespace hemitex::reference
