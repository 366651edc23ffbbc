/// The path of today's hardware: programs on the device (shader_programs.h) do all that the raster rules ask for.
///
/// An item ID is an integer of 32 bits, in textures as in the framebuffer, so that item IDs may have any format.
/// Vertices lie on the device once for all views, each with the offset of its draw. The depth is w; the smaller is the
/// nearer.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "reference/opengl/pipeline.h"

namespace hemitex::reference {

/// In the context in use. Throws InputError where the driver refuses the programs.
std::unique_ptr<OpenGlPipeline> makeShader(const raster::DrawList& list);

}  // namespace hemitex::reference
