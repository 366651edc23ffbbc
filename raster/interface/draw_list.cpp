#include "raster/interface/draw_list.h"

#include <algorithm>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::raster {
namespace {

void validateFormat(const IdFormat& format) {
  const auto isWidth = [](int bits) { return bits >= 1 && bits <= 32; };
  if (format.channelBits.empty() || !std::all_of(format.channelBits.begin(), format.channelBits.end(), isWidth) ||
      idBits(format) > 32 || idBits(format) < 2)
    throw InputError("the channels of an item ID format must be 1 to 32 bits wide, 2 to 32 bits in all");
}

/// Kernels store texel numbers as signed 32-bit integers.
constexpr std::int64_t maxTexels = std::int64_t{1} << 31;

void validateIndexMap(const IndexMap& map, ItemId largest) {
  if (std::int64_t{map.width} * map.height > maxTexels)
    throw InputError("an index map has more than 2^31 texels", "use smaller ones, or more of them");
  if (map.width < 1 || map.height < 1 ||
      map.ids.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height))
    throw InputError("an index map does not hold width x height item IDs");
  if (std::any_of(map.ids.begin(), map.ids.end(), [largest](ItemId id) { return id > largest && id != holeTexel; }))
    throw InputError("an index map holds an item ID wider than the format");
}

/// Whether `offset` blended with some item ID of the map gives the background. For most offsets the test of the largest
/// texel per channel is enough; otherwise a million draws would each read all texels of a shared map.
bool reachesBackground(const DrawList& list, ItemId offset, const IndexMap& map, ItemId largestTexel) {
  const ItemId background = backgroundId(list.format);
  const bool mayReach = list.blend == Blend::IntegerAdd
                            ? std::uint64_t{offset} + largestTexel >= background
                            : blend(list.format, list.blend, offset, largestTexel) == background;
  return mayReach && std::any_of(map.ids.begin(), map.ids.end(), [&](ItemId texel) {
           return texel != holeTexel && blend(list.format, list.blend, offset, texel) == background;
         });
}

/// The bits set in any texel but holes. No texel exceeds this item ID, neither as a whole nor in any channel.
ItemId upperBound(const IndexMap& map) {
  ItemId bits = 0;
  for (const ItemId id : map.ids) bits |= id == holeTexel ? 0 : id;
  return bits;
}

/// Whether an item ID or a triangle number of a front is the background.
bool frontReachesBackground(const DrawList& list, const Draw& draw, const std::vector<ItemId>& largestTexels) {
  const ItemId background = backgroundId(list.format);
  if (list.value == PixelValue::TriangleNumbers)
    return std::uint64_t{draw.offset} + std::max(draw.count / 3, 1U) > background;
  if (list.value == PixelValue::VertexValues) {
    const auto largest = std::max_element(list.vertexValues.begin(), list.vertexValues.end());
    return draw.offset + (largest == list.vertexValues.end() ? std::uint64_t{0} : *largest) >= background;
  }
  if (list.value == PixelValue::PassedSamples) return false;
  const auto map = static_cast<std::size_t>(draw.indexMap.value_or(0));
  return draw.indexMap ? reachesBackground(list, draw.offset, list.indexMaps[map], largestTexels[map])
                       : draw.offset == background;
}

void validateDraw(const DrawList& list, const Draw& draw, const std::vector<ItemId>& largestTexels,
                  const std::string& name) {
  const ItemId background = backgroundId(list.format);
  if (draw.offset > background || draw.back.value_or(0) > background)
    throw InputError(name + " has an offset or a back item ID wider than the format");
  if (draw.indexMap && (*draw.indexMap < 0 || static_cast<std::size_t>(*draw.indexMap) >= list.indexMaps.size()))
    throw InputError(name + " names an index map that does not exist");
  if (frontReachesBackground(list, draw, largestTexels) || draw.back == background)
    throw InputError(name + " can produce the background item ID", "use a smaller offset or a wider item ID format");
}

}  // namespace

bool hasHoles(const IndexMap& map) { return std::find(map.ids.begin(), map.ids.end(), holeTexel) != map.ids.end(); }

void validate(const DrawList& list) {
  if (!isAssembled(list)) return validate(assembled(list));
  validateFormat(list.format);
  if (list.texcoords.size() != list.positions.size())
    throw InputError("there are " + std::to_string(list.positions.size()) + " positions but " +
                     std::to_string(list.texcoords.size()) + " texture coordinates");
  if (list.clipZ.size() != (list.clipDepth == ClipDepth::None ? 0 : list.positions.size()))
    throw InputError("there are " + std::to_string(list.clipZ.size()) + " values of z",
                     "use one per position in clip space, and none in a scene");
  if (list.vertexValues.size() != (list.value == PixelValue::VertexValues ? list.positions.size() : 0))
    throw InputError("there are " + std::to_string(list.vertexValues.size()) + " values of vertices",
                     "use one per position where pixels hold them, and none elsewhere");
  const auto isMissing = [&](std::uint32_t index) { return index >= list.positions.size(); };
  if (std::any_of(list.indices.begin(), list.indices.end(), isMissing))
    throw InputError("an index names a vertex that does not exist");
  std::vector<ItemId> largestTexels;
  for (const IndexMap& map : list.indexMaps) {
    validateIndexMap(map, backgroundId(list.format));
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

void addVertex(DrawList& list, const DrawList& from, std::size_t index) {
  list.positions.push_back(from.positions[index]);
  list.texcoords.push_back(from.texcoords[index]);
  if (!from.clipZ.empty()) list.clipZ.push_back(from.clipZ[index]);
  if (!from.vertexValues.empty()) list.vertexValues.push_back(from.vertexValues[index]);
}

void removeVertices(DrawList& list) {
  list.positions.clear();
  list.texcoords.clear();
  list.clipZ.clear();
  list.vertexValues.clear();
}

bool isUsual(const DrawList& list) {
  return isAssembled(list) && list.value <= PixelValue::TriangleNumbers && list.depthTest == DepthTest::Nearer &&
         list.clipDepth == ClipDepth::None && list.depthPrecision == DepthPrecision::Exact &&
         list.front == Winding::CounterClockwise;
}

void requireUsual(const DrawList& list) {
  if (!isUsual(list))
    throw InputError("this renderer draws item IDs and triangle numbers of the nearest triangle of a scene",
                     "use the plain renderer");
}

}  // namespace hemitex::raster
