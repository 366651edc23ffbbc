/// A renderer on a real device: Vulkan, without a window. docs/backend.md walks through it as the example of a backend.
///
/// This file and its source record the commands of a view. The device is chosen in context.h, memory is allocated in
/// memory.h, and the draw list, states and shaders are in pipeline.h. Drawing writes render_targets.h.
#pragma once

#include <memory>
#include <string>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"
#include "reference/devices/vulkan/vulkan_path.h"

namespace hemitex::reference {

/// Draws with the first device whose name contains `name`. Throws InputError if the list breaks the rules or exceeds
/// the buffers of the device, or if there is no device (see context.h). Drawing throws InputError if a face breaks the
/// rules or exceeds the device's viewport, or if the device fails.
std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list,
                                                               const std::string& name = "",
                                                               VulkanPath path = VulkanPath::Graphics);

/// The whole name of that device.
std::string vulkanDeviceName(const std::string& name = "");

}  // namespace hemitex::reference
