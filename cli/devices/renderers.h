/// Makes a renderer of item buffers for a device. OpenGL and Vulkan are optional: CMake compiles their sources
/// from `built` or, where their headers are missing, from `missing`.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cli/common/console.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::cli {

enum class Device { Software, OpenGl, OpenGlFixedFunction, OpenGlPlain, Vulkan, VulkanCompute };

/// A renderer of the draw list, on the first device whose name contains `name`. Throws InputError if the device does
/// not exist or cannot draw the list.
std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device,
                                                         const std::string& name = "");

/// The name of the device with which makeRenderer draws; empty for the software.
std::string deviceName(Device device, const std::string& name = "");

/// A function that makes renderers for one of the devices of OpenGL, and prints which device draws. If there is none,
/// prints `without` and the reason, and returns an empty function.
std::function<std::unique_ptr<raster::ItemBufferRenderer>(const raster::DrawList&)> openGlRenderers(
    Device device, Console& console, const std::string& without);

/// For the three devices of OpenGL.
std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name);
std::string openGlDeviceName(const std::string& name);
/// For the two devices of Vulkan.
std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name);
std::string vulkanDeviceName(const std::string& name);

}  // namespace hemitex::cli
