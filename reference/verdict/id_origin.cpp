#include "reference/verdict/id_origin.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace hemitex::reference {
namespace {

using raster::ItemId;

/// The texels of an index map, ordered by what they hold; of equal ones the first comes first.
struct TexelIndex {
  std::vector<std::size_t> order;
  const raster::IndexMap* map;

  explicit TexelIndex(const raster::IndexMap& indexMap) : order(indexMap.ids.size()), map(&indexMap) {
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(map->ids[a], a) < std::pair(map->ids[b], b); });
  }

  std::optional<Texel> find(ItemId id) const {
    const auto place = std::lower_bound(order.begin(), order.end(), id,
                                        [&](std::size_t texel, ItemId value) { return map->ids[texel] < value; });
    if (place == order.end() || map->ids[*place] != id) return {};
    const auto width = static_cast<std::size_t>(map->width);
    return Texel{static_cast<int>(*place % width), static_cast<int>(*place / width)};
  }
};

/// The texel that gives `id` behind an offset where no channel clamps.
ItemId texelBehind(const raster::DrawList& list, ItemId offset, ItemId id) {
  return list.blend == raster::Blend::Replace ? id : (id - offset) & raster::backgroundId(list.format);
}

std::optional<IdOrigin> originIn(const raster::DrawList& list, const std::vector<TexelIndex>& maps,
                                 std::uint32_t number, ItemId id) {
  const raster::Draw& draw = list.draws[number];
  if (draw.back == id) return IdOrigin{IdOrigin::Kind::Back, number, {}};
  if (!draw.indexMap) {
    if (draw.offset != id) return {};
    return IdOrigin{IdOrigin::Kind::Offset, number, {}};
  }
  const ItemId behind = texelBehind(list, draw.offset, id);
  if (raster::blend(list.format, list.blend, draw.offset, behind) != id) return {};
  const std::optional<Texel> texel = maps[static_cast<std::size_t>(*draw.indexMap)].find(behind);
  if (!texel) return {};
  return IdOrigin{IdOrigin::Kind::Texel, number, *texel};
}

}  // namespace

IdOrigin originOf(const raster::DrawList& list, ItemId id, std::optional<std::uint32_t> likely) {
  if (id == raster::backgroundId(list.format)) return {IdOrigin::Kind::Background, 0, {}};
  const std::vector<TexelIndex> maps(list.indexMaps.begin(), list.indexMaps.end());
  if (likely)
    if (const auto origin = originIn(list, maps, *likely, id)) return *origin;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw)
    if (const auto origin = originIn(list, maps, draw, id)) return *origin;
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
