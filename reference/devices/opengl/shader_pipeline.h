/// The pipeline for hardware with shaders (shader_programs.h), which implement all rules of docs/item-buffers.md.
///
/// An item ID is a 32-bit integer in textures and in the framebuffer, so that item IDs may have any format. Vertices
/// are uploaded once for all views, each with the offset of its draw. The depth is w; smaller is nearer.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "reference/devices/opengl/pipeline.h"

namespace hemitex::reference {

/// Requires a current context. Throws InputError if the driver rejects the programs.
std::unique_ptr<OpenGlPipeline> makeShader(const raster::DrawList& list);

}  // namespace hemitex::reference
