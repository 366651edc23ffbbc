/// The device that draws the rows of a solution: the software, or a real device that draws the test vectors of the
/// suite without errors. It is judged when it is used first, which takes seconds; a file in the user's cache keeps the
/// verdict.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"
#include "reference/devices/choice/renderers.h"

namespace hemitex::reference {

struct RowDevice {
  Device device = Device::Software;
  std::string name = {};  ///< part of it
};

using RendererMaker = std::function<std::unique_ptr<raster::ItemBufferRenderer>(raster::DrawList)>;
/// Takes sentences for the user.
using Tell = std::function<void(const std::string&)>;

/// Makes renderers of the device, and tells which it is. `program` is the file with this code: another one judges anew.
/// Throws InputError if there is no device, or for one that draws test vectors with errors or sums their pixels
/// wrongly.
RendererMaker judgedRenderers(const RowDevice& device, const std::filesystem::path& program, const Tell& tell);

}  // namespace hemitex::reference
