/// Makes a renderer of item buffers for a device. OpenGL and Vulkan are optional: CMake compiles their sources
/// from `built` or, where their headers are missing, from `missing`.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::reference {

enum class Device { Software, OpenGl, OpenGlFixedFunction, OpenGlPlain, Vulkan, VulkanCompute };

/// The names of the devices that draw rows: software, vulkan, vulkan-compute, opengl.
const std::vector<std::pair<std::string, Device>>& rowDevices();

/// A renderer of the draw list, on the first device whose name contains `name`. Throws InputError if the device does
/// not exist or cannot draw the list.
std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device,
                                                         const std::string& name = "");

/// The name of the device with which makeRenderer draws; empty for the software.
std::string deviceName(Device device, const std::string& name = "");

/// For the three devices of OpenGL.
std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name);
std::string openGlDeviceName(const std::string& name);
/// For the two devices of Vulkan.
std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name);
std::string vulkanDeviceName(const std::string& name);

}  // namespace hemitex::reference
