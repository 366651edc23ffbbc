/// The pipeline that an application has by default: a 4x4 matrix, unit texture coordinates, a sampler with the nearest
/// filter, clipping at the sides of the face, and the depth of the perspective projection. Positions in clip space,
/// provoking vertices and stored depths are those of the API.
///
/// It has none of the remedies of the other pipelines, and shows what they are worth. It is as fast as plain means
/// allow: triangles share vertices, one call draws neighbours in the list with the same index map, and the fragment
/// shader adds a texel to an offset. Clamping takes several times as long, so only lists with sums that exceed a
/// channel are drawn with it.
#pragma once

#include <memory>

#include "reference/devices/opengl/pipeline.h"

namespace hemitex::reference {

/// Requires a current context. Throws InputError if the driver rejects the programs.
std::unique_ptr<OpenGlPipeline> makePlain(const raster::DrawList& list);

}  // namespace hemitex::reference
