/// The pipeline of Nielsen and Christensen (2002), for hardware without shaders.
///
/// An item ID is a colour of four bytes. An index map is a texture with such colours, and the offset of a draw is the
/// flat colour of its triangles. The texture environment adds the two per byte with clamping. The vertex stage runs on
/// the CPU for each view. It puts corners on the sub-pixels of the rules before the device snaps them. The depth is
/// n/w, whose steps are finest far away, where it changes least; greater is nearer.
#pragma once

#include <memory>

#include "reference/devices/opengl/pipeline.h"

namespace hemitex::reference {

/// Requires a current context. Throws InputError if a clamped add per byte does not give the item IDs of the list. It
/// does for channels of 8 bits with a clamped add, and in any format for item IDs that share no bits.
std::unique_ptr<OpenGlPipeline> makeFixedFunction(const raster::DrawList& list);

}  // namespace hemitex::reference
