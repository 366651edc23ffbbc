/// Calibration: computes the profile of a device (device_profile.h) from its answers to the probe vectors (probes.h).
///
/// - Snapping: each number of bits from 4 to 16, rounded or truncated, predicts which samples are covered. The result
///   is the snapping, or none, that contradicts no answer. Samples that a prediction puts on an edge determine the edge
///   rule. If they follow the rule of a picture that is upside down, the
///   rows are reversed twice, which is a fault.
/// - Edges: of two triangles that share an edge exactly one covers a sample on it, whatever their windings and their
///   order. Anything else is a fault, and no edge rule.
/// - Texels: if a coordinate at some distance from a border shows the texel beyond it, its error is larger than that
///   distance. The precision is twice the largest such distance of small coordinates. The error is above half of the
///   precision, and below the next larger distance. What large coordinates are off beyond it is rounding in binary32,
///   of an interpolated coordinate or of the product u N: the interpolation error is four times the largest number of
///   roundings, at least 2.
/// - Depth: the finest format that distinguishes all differences that it must. Of two such formats it is float32 if the
///   device distinguishes depths close to 0 that 24-bit integers cannot.
///
/// Properties without a probe keep the default: errors of the vertex stage, the tolerance of depths, loose clipping.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "raster/interface/face.h"
#include "reference/conformance/calibration/probes.h"
#include "reference/conformance/verdict/device_profile.h"

namespace hemitex::reference {

struct Calibration {
  DeviceProfile profile;            ///< valid if there are no faults
  std::vector<std::string> faults;  ///< answers that no profile explains, one line each
};

/// A snapping, and how many probes it is for and how many of these contradict it.
struct SnappingFit {
  int bits;  ///< exactBits with SnapRounding::None
  SnapRounding rounding;
  int probes, contradictions;
};

/// All snappings that `calibrate` considers, from the answers to the probes of coverage.
std::vector<SnappingFit> snappingFits(const ProbingSet& probes, std::span<const raster::ItemBuffer> answers);

/// `answers` holds one item buffer per vector of vectorsOf(probes), in their order and of their size. Those of clipping
/// are ignored.
Calibration calibrate(const ProbingSet& probes, std::span<const raster::ItemBuffer> answers);

/// Whether a device with a given snapping covers the sample of a probe.
enum class Coverage {
  Outside,
  Inside,
  OnIncludedEdge,  ///< on edges that are all top or left
  OnOtherEdge,     ///< on an edge that is neither
};
Coverage coverageOf(const CoverageProbe& probe, int subpixelBits, SnapRounding rounding);

}  // namespace hemitex::reference
