#include "raster/interface/assembly.h"

#include <algorithm>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::raster {
namespace {

using Corners = std::array<std::uint32_t, 3>;

bool isPlain(const Draw& draw) {
  return draw.topology == Topology::Triangles && !draw.restarts && draw.baseVertex == 0 && draw.firstInstance == 0 &&
         draw.instances == 0;
}

/// The number of instances that are drawn; without instances it is the mesh itself.
std::uint32_t copies(const Draw& draw) { return std::max(draw.instances, 1U); }

/// The offset of a copy, which may be too wide.
std::uint64_t offsetOf(const DrawList& list, const Draw& draw, std::uint32_t copy) {
  const ItemId id = draw.instances == 0 ? 0 : list.instances[draw.firstInstance + copy].id;
  return std::uint64_t{draw.offset} + id;
}

/// The triangle that ends at entry k + 2 of a strip or a fan. Its winding is that of the first one, and its provoking
/// vertex comes first or last.
Corners cornersAt(Topology topology, Provoking provoking, const std::vector<std::uint32_t>& run, std::size_t k) {
  const bool isFirst = provoking == Provoking::First;
  if (topology == Topology::Fan)
    return isFirst ? Corners{run[k + 1], run[k + 2], run[0]} : Corners{run[0], run[k + 1], run[k + 2]};
  if (topology == Topology::Triangles || k % 2 == 0) return {run[k], run[k + 1], run[k + 2]};
  return isFirst ? Corners{run[k], run[k + 2], run[k + 1]} : Corners{run[k + 1], run[k], run[k + 2]};
}

void requireRanges(const DrawList& list, const Draw& draw, const std::string& name) {
  if (std::uint64_t{draw.first} + draw.count > list.indices.size())
    throw InputError(name + " runs over the end of the indices");
  if (draw.topology == Topology::Triangles && !draw.restarts && draw.count % 3 != 0)
    throw InputError(name + " is not a run of whole triangles");
  if (std::uint64_t{draw.firstInstance} + draw.instances > list.instances.size())
    throw InputError(name + " names instances that do not exist");
  for (std::uint32_t k = draw.first; k < draw.first + draw.count; ++k) {
    const std::uint32_t index = list.indices[k];
    if (index > restartIndex(list)) throw InputError("an index of " + name + " has more than 16 bits");
    if (draw.restarts && index == restartIndex(list)) continue;
    if (std::uint64_t{index} + draw.baseVertex >= list.positions.size())
      throw InputError("an index of " + name + " names a vertex that does not exist");
  }
  for (std::uint32_t copy = 0; copy < copies(draw); ++copy)
    if (offsetOf(list, draw, copy) > backgroundId(list.format))
      throw InputError(name + " has an instance whose offset is wider than the format");
}

void requireRanges(const DrawList& list) {
  if (list.indexBits != 16 && list.indexBits != 32) throw InputError("indices have neither 16 nor 32 bits");
  if (list.texcoords.size() != list.positions.size() ||
      (!list.clipZ.empty() && list.clipZ.size() != list.positions.size()))
    throw InputError("positions, values of z and texture coordinates differ in number");
  if (list.value == PixelValue::VertexValues && list.vertexValues.size() != list.positions.size())
    throw InputError("there is not one value per position");
  for (std::size_t i = 0; i < list.draws.size(); ++i) requireRanges(list, list.draws[i], "draw " + std::to_string(i));
  if (list.value != PixelValue::Pairs) return;
  const auto hasBack = [](const Draw& draw) { return draw.back.has_value(); };
  if (idBits(list.format) != 32 || std::any_of(list.draws.begin(), list.draws.end(), hasBack))
    throw InputError("pairs have 32-bit offsets and triangle numbers, and no back item ID");
}

/// Appends the vertices of an instance; returns their places.
std::map<std::uint32_t, std::uint32_t> addVertices(DrawList& result, const DrawList& list,
                                                   const std::vector<Corners>& triangles, const Instance& instance) {
  std::map<std::uint32_t, std::uint32_t> places;
  for (const Corners& corners : triangles)
    for (const std::uint32_t vertex : corners) {
      if (!places.try_emplace(vertex, static_cast<std::uint32_t>(result.positions.size())).second) continue;
      addVertex(result, list, vertex);
      glm::vec3& position = result.positions.back();
      const bool isClip = !list.clipZ.empty();
      const glm::vec3 scale(instance.scale.x, instance.scale.y, isClip ? instance.scale.w : instance.scale.z);
      const glm::vec3 offset(instance.offset.x, instance.offset.y, isClip ? instance.offset.w : instance.offset.z);
      position = position * scale + offset;
      if (isClip) result.clipZ.back() = result.clipZ.back() * instance.scale.z + instance.offset.z;
    }
  return places;
}

}  // namespace

bool isAssembled(const DrawList& list) {
  return list.value != PixelValue::Pairs && list.indexBits == 32 && list.instances.empty() &&
         std::all_of(list.draws.begin(), list.draws.end(), isPlain);
}

std::vector<Corners> trianglesOf(const DrawList& list, const Draw& draw) {
  std::vector<Corners> triangles;
  std::vector<std::uint32_t> run;
  const std::size_t step = draw.topology == Topology::Triangles ? 3 : 1;
  const auto endRun = [&] {
    for (std::size_t k = 0; k + 2 < run.size(); k += step)
      triangles.push_back(cornersAt(draw.topology, list.provoking, run, k));
    run.clear();
  };
  for (std::uint32_t k = draw.first; k < draw.first + draw.count; ++k) {
    if (draw.restarts && list.indices[k] == restartIndex(list))
      endRun();
    else
      run.push_back(list.indices[k] + draw.baseVertex);
  }
  endRun();
  return triangles;
}

DrawList assembled(const DrawList& list) {
  if (isAssembled(list)) return list;
  requireRanges(list);
  DrawList result = list;
  result.indices.clear();
  result.draws.clear();
  result.instances.clear();
  result.indexBits = 32;
  const bool arePairs = list.value == PixelValue::Pairs;
  if (arePairs) result.value = PixelValue::TriangleNumbers;
  const PairNumbers pairs(list);
  for (const Draw& draw : list.draws) {
    const std::vector<Corners> triangles = trianglesOf(list, draw);
    for (std::uint32_t copy = 0; copy < copies(draw); ++copy) {
      const auto offset = static_cast<ItemId>(offsetOf(list, draw, copy));
      result.draws.push_back({static_cast<std::uint32_t>(result.indices.size()),
                              static_cast<std::uint32_t>(3 * triangles.size()),
                              arePairs ? pairs.baseOf(offset) : offset, draw.back, draw.indexMap, draw.cull});
      const auto places = draw.instances == 0
                              ? std::map<std::uint32_t, std::uint32_t>{}
                              : addVertices(result, list, triangles, list.instances[draw.firstInstance + copy]);
      for (const Corners& corners : triangles)
        for (const std::uint32_t vertex : corners)
          result.indices.push_back(draw.instances == 0 ? vertex : places.at(vertex));
    }
  }
  return result;
}

PairNumbers::PairNumbers(const DrawList& list) {
  if (list.value != PixelValue::Pairs) return;
  for (const Draw& draw : list.draws)
    for (std::uint32_t copy = 0; copy < copies(draw); ++copy) {
      Range& range = ranges_[static_cast<ItemId>(offsetOf(list, draw, copy))];
      range.triangles = std::max(range.triangles, static_cast<std::uint32_t>(trianglesOf(list, draw).size()));
    }
  ItemId base = 0;
  for (auto& [offset, range] : ranges_) {
    range.base = base;
    base += range.triangles;
  }
}

ItemId PairNumbers::numberOf(std::uint64_t pair) const {
  const auto range = ranges_.find(static_cast<ItemId>(pair >> 32));
  const auto triangle = static_cast<std::uint32_t>(pair);
  if (range != ranges_.end() && triangle < range->second.triangles) return range->second.base + triangle;
  return pair == UINT64_MAX ? 0xffffffff : 0xfffffffe;
}

std::uint64_t PairNumbers::pairOf(ItemId number) const {
  for (const auto& [offset, range] : ranges_)
    if (number >= range.base && number - range.base < range.triangles)
      return (std::uint64_t{offset} << 32) + (number - range.base);
  return number == 0xffffffff ? UINT64_MAX : UINT64_MAX - 1;
}

}  // namespace hemitex::raster
