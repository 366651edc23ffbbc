/// Two faults in one device.
#pragma once

#include <optional>

#include "reference/conformance/diagnosis/staged_device.h"

namespace hemitex::reference {

/// The device with the changed stages of both. Where both change uploads, views, facings, distances or what is read
/// back, the change of `first` comes first. Nothing where both replace the same other stage.
std::optional<StagedDevice> pairOf(const StagedDevice& first, const StagedDevice& second);

}  // namespace hemitex::reference
