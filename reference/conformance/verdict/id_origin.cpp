#include "reference/conformance/verdict/id_origin.h"

#include <algorithm>

namespace hemitex::reference {
namespace {

using raster::ItemId;

/// The first texel of an index map that holds `id`.
std::optional<Texel> findTexel(const raster::IndexMap& map, ItemId id) {
  const auto place = std::find(map.ids.begin(), map.ids.end(), id);
  if (place == map.ids.end()) return {};
  const auto texel = static_cast<int>(place - map.ids.begin());
  return Texel{texel % map.width, texel / map.width};
}

/// The texel that gives `id` with an offset if no channel clamps.
ItemId texelUnder(const raster::DrawList& list, ItemId offset, ItemId id) {
  return list.blend == raster::Blend::Replace ? id : (id - offset) & raster::backgroundId(list.format);
}

std::optional<IdOrigin> originIn(const raster::DrawList& list, std::uint32_t number, ItemId id) {
  const raster::Draw& draw = list.draws[number];
  if (draw.back == id) return IdOrigin{IdOrigin::Kind::Back, number, {}};
  if (!draw.indexMap) {
    if (draw.offset != id) return {};
    return IdOrigin{IdOrigin::Kind::Offset, number, {}};
  }
  const ItemId behind = texelUnder(list, draw.offset, id);
  if (raster::blend(list.format, list.blend, draw.offset, behind) != id) return {};
  const std::optional<Texel> texel = findTexel(list.indexMaps[static_cast<std::size_t>(*draw.indexMap)], behind);
  if (!texel) return {};
  return IdOrigin{IdOrigin::Kind::Texel, number, *texel};
}

}  // namespace

IdOrigin originOf(const raster::DrawList& list, ItemId id, std::optional<std::uint32_t> likely) {
  if (id == raster::backgroundId(list.format)) return {IdOrigin::Kind::Background, 0, {}};
  if (likely)
    if (const auto origin = originIn(list, *likely, id)) return *origin;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw)
    if (const auto origin = originIn(list, draw, id)) return *origin;
  return {};
}

std::string toText(const IdOrigin& origin) {
  const std::string draw = "draw " + std::to_string(origin.draw);
  switch (origin.kind) {
    case IdOrigin::Kind::Background:
      return "background";
    case IdOrigin::Kind::Back:
      return "back of " + draw;
    case IdOrigin::Kind::Offset:
      return draw;
    case IdOrigin::Kind::Texel:
      return draw + " texel " + std::to_string(origin.texel.column) + "," + std::to_string(origin.texel.row);
    case IdOrigin::Kind::Unknown:
      break;
  }
  return "no draw";
}

}  // namespace hemitex::reference
