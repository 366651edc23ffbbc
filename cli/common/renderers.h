/// Makes a renderer of item buffers for a device. CMake compiles renderers_opengl.cpp, or renderers_software.cpp if
/// libepoxy is not installed.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::cli {

enum class Device { Software, OpenGl, OpenGlFixedFunction };

/// A renderer of the draw list. Throws InputError if the device does not exist or cannot draw the list.
std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device);

}  // namespace hemitex::cli
