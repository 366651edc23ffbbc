/// Makes a renderer of item buffers for a device. OpenGL and Vulkan are optional: CMake compiles opengl.cpp or
/// without_opengl.cpp, and vulkan.cpp or without_vulkan.cpp.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::cli {

enum class Device { Software, OpenGl, OpenGlFixedFunction, OpenGlPlain, Vulkan };

/// A renderer of the draw list. Throws InputError if the device does not exist or cannot draw the list.
std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device);

/// For the three devices of OpenGL.
std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList& list, Device device);
std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list);

}  // namespace hemitex::cli
