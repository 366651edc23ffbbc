/// The path of Nielsen and Christensen (2002): no program runs on the device; what hardware had then is enough.
///
/// An item ID is a colour of four bytes. An index map is a texture with such colours, the offset of a draw the flat
/// colour of its triangles, and the texture environment adds the two, each byte by itself and clamped. The vertex stage
/// runs on the CPU, for each view anew, and puts corners on the sub-pixels of the rules before the device snaps them in
/// its own way. The depth is n/w, whose steps are finest far away, where it changes least; the greater is the nearer.
#pragma once

#include <memory>

#include "raster/interface/draw_list.h"
#include "reference/opengl/pipeline.h"

namespace hemitex::reference {

/// In the context in use. Throws InputError where adding byte by byte, each clamped, does not give the item IDs of the
/// list: that takes channels of 8 bits with a clamped add or, in any format, item IDs that share no bits.
std::unique_ptr<OpenGlPipeline> makeFixedFunction(const raster::DrawList& list);

}  // namespace hemitex::reference
