/// The draw and the texel that produce an item ID: they show what a wrong item ID names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "raster/interface/draw_list.h"
#include "reference/conformance/trace/fragments.h"

namespace hemitex::reference {

/// The origin of an item ID: the background, or a draw that may produce it. With aligned offsets the draw is the
/// surface and the texel the element.
struct IdOrigin {
  enum class Kind { Background, Back, Offset, Texel, Unknown };
  Kind kind = Kind::Unknown;
  std::uint32_t draw = 0;  ///< of Back, Offset and Texel
  Texel texel;             ///< of Texel: the first one of the draw's index map that holds the index
};

/// The origin of `id`: draw `likely` if it is given and produces the item ID, else the first draw that does. The origin
/// of a sum with a clamped channel is unknown.
IdOrigin originOf(const raster::DrawList& list, raster::ItemId id, std::optional<std::uint32_t> likely = {});
/// "background", "back of draw 3", "draw 3", "draw 3 texel 5,7", "no draw".
std::string toText(const IdOrigin& origin);

}  // namespace hemitex::reference
