/// Diagnoses systematic errors of a device: it draws the vector with each known fault (fault.h) and names the fault
/// that gives the item IDs of the device.
///
/// The footprint of a fault is the set of pixels where it changes the item IDs of the rules. The agreement of a fault
/// is the fraction of the error pixels and the footprint where the device holds the item ID of the fault. A device with
/// the fault agrees except for its own small errors; other devices hardly ever agree. The fault explains the errors if
/// this agreement, and that on the error pixels alone, is at least 0.9.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "reference/conformance/verdict/verdict.h"

namespace hemitex::reference {

/// A fault that explains the errors.
struct Finding {
  std::string fault;
  std::string variant;  ///< the variant with the best agreement; may be empty
  double agreement;     ///< from 0.9 to 1
  std::string advice;   ///< where to look
};

struct Diagnosis {
  /// Of the faults that explain the errors on at least eight pixels the one with the most equal item IDs. With it come
  /// the faults that the vector cannot distinguish from it: the pixels where only one of the two gives the device's
  /// item ID are no more than chance allows.
  std::vector<Finding> findings;
  /// The names of all faults that explain the errors, on however few pixels.
  std::vector<std::string> explaining;
};

/// Empty without errors.
Diagnosis diagnoseAll(const TestVector& vector, const Verdict& verdict);

/// The findings alone.
std::vector<Finding> diagnose(const TestVector& vector, const Verdict& verdict);

/// Two different faults, the change of the first one before that of the second.
using PairFinding = std::array<Finding, 2>;

/// The pairs of known faults that explain the errors together on at least eight pixels: the one with the most equal
/// item IDs, and those that the vector cannot distinguish from it. With `names` only pairs of these faults. Agreements
/// are those of the pair. Its cost is that of all pairs of variants, most of which are rejected after some rows.
std::vector<PairFinding> diagnosePairs(const TestVector& vector, const Verdict& verdict,
                                       std::span<const std::string> names = {});

/// "linear filtering (99.8 % agreement): set both filters ..."; several are joined with "either" and "or".
std::string toText(const std::vector<Finding>& findings);

}  // namespace hemitex::reference
