/// Guesses the class of a device from the errors of a check against the default profile, before anything was measured.
/// Each hypothesis changes one property of the profile as calibration.h does, and judges the same item buffers again.
///
/// A guess is no proof: a wider profile also explains some errors of faults. The probes measure the device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "reference/conformance/verdict/verdict.h"

namespace hemitex::reference {

/// A vector and the verdict on it under the default profile.
struct JudgedVector {
  const TestVector* vector;
  const Verdict* verdict;
};

struct DeviceClass {
  DeviceProfile profile;        ///< the default one with the guessed properties
  std::string properties;       ///< "4 sub-pixel bits and 16-bit depths"
  std::uint64_t errors = 0;     ///< under the default profile
  std::uint64_t explained = 0;  ///< of these, by the class
};

/// The class with the fewest and smallest changes that explains nearly as many errors as any. Nothing without errors or
/// where less than half of them are explained. Its cost is that of about 20 verdicts on the vectors with errors.
std::optional<DeviceClass> guessDeviceClass(std::span<const JudgedVector> vectors);

/// "856 of 858 errors fit a device with 4 sub-pixel bits".
std::string toText(const DeviceClass& guess);

}  // namespace hemitex::reference
