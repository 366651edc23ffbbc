#include "raster/interface/draw_list.h"

#include <algorithm>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::raster {
namespace {

void validateFormat(const WordFormat& format) {
  const auto isWidth = [](int bits) { return bits >= 1 && bits <= 32; };
  if (format.channelBits.empty() || !std::all_of(format.channelBits.begin(), format.channelBits.end(), isWidth) ||
      wordBits(format) > 32 || wordBits(format) < 2)
    throw InputError("the channels of a word format must be 1 to 32 bits wide, 2 to 32 bits in all");
}

/// Kernels number texels by 32-bit integers with a sign.
constexpr std::int64_t mostTexels = std::int64_t{1} << 31;

void validateIndexMap(const IndexMap& map, Word largest) {
  if (std::int64_t{map.width} * map.height > mostTexels)
    throw InputError("an index map has more than 2^31 texels", "use smaller ones, or more of them");
  if (map.width < 1 || map.height < 1 ||
      map.words.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height))
    throw InputError("an index map does not hold width x height words");
  if (std::any_of(map.words.begin(), map.words.end(), [largest](Word word) { return word > largest; }))
    throw InputError("an index map holds a word wider than the format");
}

/// Whether `offset` blended with some word of the map gives the background. The largest texel, channel by channel,
/// answers for most offsets, so that a million draws with one map do not look at every texel of it.
bool reachesBackground(const DrawList& list, Word offset, const IndexMap& map, Word largestTexel) {
  const Word background = backgroundWord(list.format);
  const bool mayReach = list.blend == Blend::IntegerAdd
                            ? std::uint64_t{offset} + largestTexel >= background
                            : blend(list.format, list.blend, offset, largestTexel) == background;
  return mayReach && std::any_of(map.words.begin(), map.words.end(), [&](Word texel) {
           return blend(list.format, list.blend, offset, texel) == background;
         });
}

/// The bits set in any texel: no texel exceeds this word, as a whole or in any channel.
Word upperBound(const IndexMap& map) {
  Word bits = 0;
  for (const Word word : map.words) bits |= word;
  return bits;
}

void validateDraw(const DrawList& list, const Draw& draw, const std::vector<Word>& largestTexels,
                  const std::string& name) {
  const Word background = backgroundWord(list.format);
  if (draw.offset > background || draw.back.value_or(0) > background)
    throw InputError(name + " has an offset or a back word wider than the format");
  const auto map = static_cast<std::size_t>(draw.indexMap.value_or(0));
  if (draw.indexMap && (*draw.indexMap < 0 || map >= list.indexMaps.size()))
    throw InputError(name + " names an index map that does not exist");
  const bool frontReaches = draw.indexMap
                                ? reachesBackground(list, draw.offset, list.indexMaps[map], largestTexels[map])
                                : draw.offset == background;
  if (frontReaches || draw.back == background)
    throw InputError(name + " can produce the background word", "use a smaller offset or a wider word format");
}

}  // namespace

void validate(const DrawList& list) {
  validateFormat(list.format);
  if (list.texcoords.size() != list.positions.size())
    throw InputError("there are " + std::to_string(list.positions.size()) + " positions but " +
                     std::to_string(list.texcoords.size()) + " texture coordinates");
  const auto isMissing = [&](std::uint32_t index) { return index >= list.positions.size(); };
  if (std::any_of(list.indices.begin(), list.indices.end(), isMissing))
    throw InputError("an index names a vertex that does not exist");
  std::vector<Word> largestTexels;
  for (const IndexMap& map : list.indexMaps) {
    validateIndexMap(map, backgroundWord(list.format));
    largestTexels.push_back(upperBound(map));
  }
  for (std::size_t i = 0; i < list.draws.size(); ++i) {
    const Draw& draw = list.draws[i];
    const std::string name = "draw " + std::to_string(i);
    if (draw.first % 3 != 0 || draw.count % 3 != 0) throw InputError(name + " is not a run of whole triangles");
    if (std::uint64_t{draw.first} + draw.count > list.indices.size())
      throw InputError(name + " runs over the end of the indices");
    validateDraw(list, draw, largestTexels, name);
  }
}

}  // namespace hemitex::raster
