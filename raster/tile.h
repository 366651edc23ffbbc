/// Tiles: a face is drawn in parts, each on its own and small enough to stay in a processor's second-level cache. In a
/// tile, triangles are set up and offered to the depth buffer, the nearest clusters first; then the words of the pixels
/// are resolved, once a visible pixel. Small triangles have as few pixels as there are of them: theirs are resolved
/// while all that they need is at hand, when a pixel takes them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/face.h"
#include "raster/pixel_kernels.h"
#include "raster/prepared_draws.h"

namespace hemitex::raster {

/// Scissor rectangles that together are the face's own.
std::vector<Scissor> tilesOf(const Face& face);

/// Draws the part of a face that lies in its scissor rectangle: a word a pixel, row by row from `words` on, `pitch`
/// words from row to row. Returns the number of triangles that were dropped because a value was not finite.
std::uint64_t drawTile(const PreparedDraws& draws, const PixelKernels& kernels, const Face& face,
                       std::span<const std::uint32_t> skipped, Word* words, std::size_t pitch);

}  // namespace hemitex::raster
