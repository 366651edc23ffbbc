/// The pipeline that an application has by default: a 4x4 matrix, unit texture coordinates, a sampler with the nearest
/// filter, one call per draw, clipping at the sides of the face, and the depth of the perspective projection.
///
/// It has none of the remedies of the other pipelines, and shows what they are worth. Only the blend is that of
/// shader_pipeline.h, so that item IDs may have any format.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "reference/opengl/pipeline.h"

namespace hemitex::reference {

/// Requires a current context. Throws InputError if the driver rejects the programs.
std::unique_ptr<OpenGlPipeline> makePlain(const raster::DrawList& list);

}  // namespace hemitex::reference
