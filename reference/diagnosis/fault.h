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
  /// Where devices round differently: an item ID that is off by at most one in each of these channels is forgiven.
  std::vector<Channel> rounded = {};
};

struct Fault {
  std::string name;    ///< in the field's item IDs
  std::string advice;  ///< one line: where to look
  std::vector<Variant> variants;
};

/// All known faults, in a fixed order, with the variants that the vector's faces and item ID format allow.
std::vector<Fault> knownFaults(const TestVector& vector);

/// The known faults of each stage, a source file each.
std::vector<Fault> viewFaults(const TestVector& vector);     ///< flipped, exchanged, turned, moved views and pictures
std::vector<Fault> sampleFaults(const TestVector& vector);   ///< facing, coverage and depth
std::vector<Fault> textureFaults(const TestVector& vector);  ///< how index maps are looked up
std::vector<Fault> blendFaults(const TestVector& vector);    ///< offsets, and how they meet texels and the target
std::vector<Fault> memoryFaults(
    const TestVector& vector);  ///< item IDs in memory: channels, bytes, bits, rows, colours

}  // namespace hemitex::reference
