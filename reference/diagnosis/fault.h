/// The faults that a diagnosis knows by name: what goes wrong in OpenGL and Vulkan backends of this method, each as a
/// device (staged_device.h) in which one or two stages are wrong.
///
/// What a backend does under a fault depends on details that nobody knows from outside, such as the number of samples
/// or the alignment of rows: a fault has a *variant* for each that is common.
#pragma once

#include <string>
#include <vector>

#include "reference/diagnosis/colour_channels.h"
#include "reference/diagnosis/staged_device.h"

namespace hemitex::reference {

struct Variant {
  std::string name;  ///< may be empty
  StagedDevice device;
  /// Where devices round differently: a word that is off by at most one in each of these channels is forgiven.
  std::vector<Channel> rounded = {};
};

struct Fault {
  std::string name;    ///< in the field's words
  std::string advice;  ///< one line: where to look
  std::vector<Variant> variants;
};

/// All known faults, in a fixed order, with the variants that the vector's faces and word format allow.
std::vector<Fault> knownFaults(const TestVector& vector);

}  // namespace hemitex::reference
