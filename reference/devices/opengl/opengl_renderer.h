/// A renderer on a real device: OpenGL through EGL, without a window. It is an example of a backend for this method,
/// and it provides a device for verdicts (verdict.h).
///
/// This file holds textures, framebuffer and viewport. The context is in context.h and the interface of the pipelines
/// in pipeline.h. Joined draws are in batches.h.
///
/// By default a device differs from docs/item-buffers.md in four ways. Each has a remedy here, except on the plain
/// path:
/// - It clips triangles at the sides of its view. The view is as wide as the guard band of the rules, and the
///   framebuffer shows its scissor rectangle (viewport.h).
/// - It has its own snapping and interpolates between corners that are not snapped. Corners are put on sub-pixels
///   beforehand; the shaders clip at the near plane before that.
/// - It rounds u N before the floor function. Texture coordinates are in texels.
/// - It interpolates in binary32. The two pipelines solve this in different ways.
#pragma once

#include <memory>
#include <string>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::reference {

enum class OpenGlPath {
  FixedFunction,  ///< as in Nielsen and Christensen (2002), without shaders (fixed_function_pipeline.cpp)
  Shader,         ///< shaders that implement all rules, for any format of item IDs (shader_pipeline.cpp)
  Plain,          ///< what an application does by default, without any remedy (plain_pipeline.cpp)
};

/// Draws with the first device whose name contains `name`. Throws InputError if the list breaks the rules, there is no
/// device (see context.h), or an index map exceeds the device's textures, on the shader path its buffers. Also throws
/// it if the path cannot draw the list. Fixed-function hardware adds only channels of 8 bits with clamping and, in any
/// format, item IDs that share no bits. It discards no holes, and draws no values but item IDs.
///
/// Drawing throws InputError if a face breaks the rules or exceeds the device's viewport, or if the device fails. The
/// fixed-function path draws the fronts of a draw before its backs: at equal depths the front is visible.
std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList& list, OpenGlPath path,
                                                               const std::string& name = "");

/// The whole name of that device.
std::string openGlDeviceName(const std::string& name = "");

}  // namespace hemitex::reference
