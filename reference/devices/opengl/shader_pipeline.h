/// The pipeline for hardware with shaders (item_ids.vert), which implement all rules of docs/item-buffers.md.
///
/// An item ID is a 32-bit integer in buffers and in the framebuffer, so that item IDs may have any format. The draw
/// list is uploaded once for all views (shader_inputs.h). In a scene the depth is w, unless it is stored; smaller is
/// nearer.
#pragma once

#include <memory>

#include "reference/devices/opengl/pipeline.h"

namespace hemitex::reference {

/// Requires a current context. Throws InputError if the driver rejects the programs, or if the index maps exceed a
/// buffer of the device.
std::unique_ptr<OpenGlPipeline> makeShader(const raster::DrawList& list);

}  // namespace hemitex::reference
