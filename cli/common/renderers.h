/// What the program can draw item buffers on. Where it was built without libepoxy there is no OpenGL:
/// renderers_opengl.cpp or renderers_software.cpp is this header's other half.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::cli {

enum class Device { Software, OpenGl, OpenGlFixedFunction };

/// A renderer of the list. Throws InputError where the device is not there, or cannot draw the list.
std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device);

}  // namespace hemitex::cli
