/// Which draw and which texel an item ID comes from: what a wrong item ID names instead of the right one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "raster/interface/draw_list.h"
#include "reference/trace/fragments.h"

namespace hemitex::reference {

/// What an item ID stands for: the background, or a draw that may give it. With aligned item IDs the draw is the
/// surface and the texel the element.
struct IdOrigin {
  enum class Kind { Background, Back, Offset, Texel, Unknown };
  Kind kind = Kind::Unknown;
  std::uint32_t draw = 0;  ///< that gives the item ID; of Back, Offset and Texel
  Texel texel;             ///< of Texel: where the draw's index map first holds the index
};

/// Where `id` comes from: from draw `likely`, where there is one and it gives the item ID, else from the first draw
/// that does. A sum that some channel clamped cannot be taken apart: unknown.
IdOrigin originOf(const raster::DrawList& list, raster::ItemId id, std::optional<std::uint32_t> likely = {});
/// "background", "back of draw 3", "draw 3", "draw 3 texel 5,7", "no draw".
std::string toText(const IdOrigin& origin);

}  // namespace hemitex::reference
