/// The device that draws the rows of a solution: the software, or a real device that draws the test vectors of the
/// suite without errors. It is judged when it is used first, which takes seconds; a file in the user's cache keeps the
/// verdict.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cli/common/options.h"
#include "cli/devices/renderers.h"

namespace hemitex::cli {

struct RowDevice {
  Device device = Device::Software;
  std::string name = {};  ///< part of it
};

using RendererMaker = std::function<std::unique_ptr<raster::ItemBufferRenderer>(raster::DrawList)>;

/// Adds `--device` and `--device-name`.
void addRowDevice(Command command, RowDevice& device);

/// Makes renderers of the device, and says which it is. Throws InputError if there is none, or for one that draws test
/// vectors with errors or sums their pixels wrongly.
RendererMaker rowRenderers(const RowDevice& device, Console& console);

}  // namespace hemitex::cli
