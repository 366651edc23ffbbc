/// The known faults of OpenGL and Vulkan backends of this method. Each is a device (staged_device.h) with one or two
/// wrong stages.
///
/// The effect of a fault depends on details of the backend, such as the number of samples or the alignment of rows. A
/// fault has a *variant* for each common case.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "reference/conformance/diagnosis/staged_device.h"
#include "reference/conformance/vectors/colour_channels.h"

namespace hemitex::reference {

struct Variant {
  std::string name;  ///< may be empty
  StagedDevice device;
  /// Channels that devices round differently: an item ID that is off by at most one in each of them counts as equal.
  std::vector<Channel> rounded = {};
  bool isPartial = false;  ///< whether devices make only a part of the changes, which part depends on the device
};

struct Fault {
  std::string name;    ///< in standard graphics terms
  std::string advice;  ///< one line: where to look
  std::vector<Variant> variants;
};

using IdChange = std::function<raster::ItemId(raster::ItemId)>;

/// A device that changes each item ID when it is read back.
StagedDevice withIds(const IdChange& change);

/// All known faults, in a fixed order, with the variants that the vector's faces and item ID format allow.
std::vector<Fault> knownFaults(const TestVector& vector);

/// Front and back exchanged where the determinant of the view is negative.
Variant turnedInMirroredViews(const std::string& name);

/// The known faults by stage, one source file each.
std::vector<Fault> viewFaults(const TestVector& vector);      ///< flipped, exchanged, rotated, moved views and pictures
std::vector<Fault> geometryFaults(const TestVector& vector);  ///< indices, transformation, clipping, snapping
std::vector<Fault> sampleFaults(const TestVector& vector);    ///< facing, coverage and depth
std::vector<Fault> textureFaults(const TestVector& vector);   ///< lookups in index maps
std::vector<Fault> blendFaults(const TestVector& vector);     ///< offsets, and their blends with texels and the target
std::vector<Fault> memoryFaults(const TestVector& vector);    ///< channels, bytes, bits, rows and colours in memory
std::vector<Fault> drawFaults(const TestVector& vector);      ///< states of draws, and what happens to their item IDs
std::vector<Fault> assemblyFaults(const TestVector& vector);  ///< of what version 2 adds

/// Fog whose density is that of the item IDs of a device, one per pixel of all faces: none is known beforehand.
Fault fogLike(const PlacedVector& placed, std::span<const raster::ItemId> found);

}  // namespace hemitex::reference
