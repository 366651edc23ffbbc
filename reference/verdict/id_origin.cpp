#include "reference/verdict/id_origin.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace hemitex::reference {
namespace {

using raster::Word;

/// The texels of an index map, ordered by what they hold; of equal ones the first comes first.
struct TexelIndex {
  std::vector<std::size_t> order;
  const raster::IndexMap* map;

  explicit TexelIndex(const raster::IndexMap& indexMap) : order(indexMap.words.size()), map(&indexMap) {
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(map->words[a], a) < std::pair(map->words[b], b); });
  }

  std::optional<Texel> find(Word word) const {
    const auto place = std::lower_bound(order.begin(), order.end(), word,
                                        [&](std::size_t texel, Word value) { return map->words[texel] < value; });
    if (place == order.end() || map->words[*place] != word) return {};
    const auto width = static_cast<std::size_t>(map->width);
    return Texel{static_cast<int>(*place % width), static_cast<int>(*place / width)};
  }
};

/// The texel that gives `word` behind an offset where no channel clamps.
Word texelBehind(const raster::DrawList& list, Word offset, Word word) {
  return list.blend == raster::Blend::Replace ? word : (word - offset) & raster::backgroundWord(list.format);
}

std::optional<WordOrigin> originIn(const raster::DrawList& list, const std::vector<TexelIndex>& maps,
                                   std::uint32_t number, Word word) {
  const raster::Draw& draw = list.draws[number];
  if (draw.back == word) return WordOrigin{WordOrigin::Kind::Back, number, {}};
  if (!draw.indexMap) {
    if (draw.offset != word) return {};
    return WordOrigin{WordOrigin::Kind::Offset, number, {}};
  }
  const Word behind = texelBehind(list, draw.offset, word);
  if (raster::blend(list.format, list.blend, draw.offset, behind) != word) return {};
  const std::optional<Texel> texel = maps[static_cast<std::size_t>(*draw.indexMap)].find(behind);
  if (!texel) return {};
  return WordOrigin{WordOrigin::Kind::Texel, number, *texel};
}

}  // namespace

WordOrigin originOf(const raster::DrawList& list, Word word, std::optional<std::uint32_t> likely) {
  if (word == raster::backgroundWord(list.format)) return {WordOrigin::Kind::Background, 0, {}};
  const std::vector<TexelIndex> maps(list.indexMaps.begin(), list.indexMaps.end());
  if (likely)
    if (const auto origin = originIn(list, maps, *likely, word)) return *origin;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw)
    if (const auto origin = originIn(list, maps, draw, word)) return *origin;
  return {};
}

std::string toText(const WordOrigin& origin) {
  const std::string draw = "draw " + std::to_string(origin.draw);
  switch (origin.kind) {
    case WordOrigin::Kind::Background:
      return "background";
    case WordOrigin::Kind::Back:
      return "back of " + draw;
    case WordOrigin::Kind::Offset:
      return draw;
    case WordOrigin::Kind::Texel:
      return draw + " texel " + std::to_string(origin.texel.column) + "," + std::to_string(origin.texel.row);
    case WordOrigin::Kind::Unknown:
      break;
  }
  return "no draw";
}

}  // namespace hemitex::reference
