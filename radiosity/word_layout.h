/// The word layout: which word stands for which element. A textured surface takes an offset aligned to 2^k, where k
/// bits hold the largest index map; a surface of one texel takes a single word behind them. Without alignment the
/// offsets follow each other without a gap, which only an integer add can draw (Nielsen and Christensen 2002, 3.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "radiosity/discretization.h"
#include "raster/draw_list.h"
#include "raster/word.h"

namespace hemitex::radiosity {

struct WordLayout {
  raster::WordFormat format;
  raster::Blend blend = raster::Blend::ClampedAdd;
  bool aligned = true;
  int indexBits = 0;                    ///< k: 2^k holds the largest index map of a textured surface
  std::vector<raster::Word> offset;     ///< one a surface
  std::vector<std::uint32_t> byOffset;  ///< the surfaces in ascending order of their offsets
  std::uint32_t textured = 0;           ///< surfaces with an index map; where aligned, the first in byOffset
};

/// The indices that no texel with area produces, by cause.
struct Phantoms {
  std::uint64_t spareTexels = 0;    ///< texels of an index map without area on the surface
  std::uint64_t alignmentGaps = 0;  ///< indices between the end of an index map and the next aligned offset
};

/// `blend` is ClampedAdd or IntegerAdd. Throws InputError where no format has that name, or where the scene does not
/// fit the word (surfaces x 2^k over the format's range, two words reserved); the advice says which format, or which
/// number of texels, would fit. Every offset plus index is below the reserved words, and so is what a clamped add makes
/// of it: clamping only lowers a sum.
WordLayout layOut(const Discretization& discretization, std::string_view formatName, raster::Blend blend, bool aligned);

Phantoms countPhantoms(const Discretization& discretization, const WordLayout& layout);

/// A texel of a surface.
struct SurfaceTexel {
  std::uint32_t surface = 0;
  std::uint32_t texel = 0;
};

/// The texel a word stands for; nothing for the reserved words and for words that no draw can produce. Where ClampedAdd
/// changes an unaligned sum, the texel is that of the word it was changed into.
std::optional<SurfaceTexel> texelOf(const Discretization& discretization, const WordLayout& layout, raster::Word word);

/// The draws of the scene: one a surface, its chart under the shared index map of its size, its back the reserved
/// back word. Triangle t of the list is triangle t of the scene.
raster::DrawList makeDrawList(const Scene& scene, const Discretization& discretization, const WordLayout& layout);

}  // namespace hemitex::radiosity
