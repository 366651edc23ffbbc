/// The device that draws rows, chosen by options.
#pragma once

#include <string>

#include "cli/common/console.h"
#include "cli/common/options.h"
#include "reference/devices/choice/judged_device.h"

namespace hemitex::cli {

using reference::Device;
using reference::RendererMaker;
using reference::RowDevice;

/// Adds `--device` and `--device-name`.
void addRowDevice(Command command, RowDevice& device);

/// Makes renderers of the device, and says which it is (see judgedRenderers).
RendererMaker rowRenderers(const RowDevice& device, Console& console);

/// A function that makes renderers for one of the devices of OpenGL, which is not judged, and prints which device
/// draws. If there is none, prints `without` and the reason, and returns an empty function.
RendererMaker openGlRenderers(Device device, Console& console, const std::string& without);

}  // namespace hemitex::cli
