/// Which draw and which texel a word comes from: what a wrong word names instead of the right one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "raster/interface/draw_list.h"
#include "reference/trace/fragments.h"

namespace hemitex::reference {

/// What a word stands for: the background, or a draw that may give it. With aligned words the draw is the surface and
/// the texel the element.
struct WordOrigin {
  enum class Kind { Background, Back, Offset, Texel, Unknown };
  Kind kind = Kind::Unknown;
  std::uint32_t draw = 0;  ///< that gives the word; of Back, Offset and Texel
  Texel texel;             ///< of Texel: where the draw's index map first holds the index
};

/// Where `word` comes from: from draw `likely`, where there is one and it gives the word, else from the first draw that
/// does. A sum that some channel clamped cannot be taken apart: unknown.
WordOrigin originOf(const raster::DrawList& list, raster::Word word, std::optional<std::uint32_t> likely = {});
/// "background", "back of draw 3", "draw 3", "draw 3 texel 5,7", "no draw".
std::string toText(const WordOrigin& origin);

}  // namespace hemitex::reference
