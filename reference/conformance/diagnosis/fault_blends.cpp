/// Faults of offsets, and of their blends with texels and the target.
#include <algorithm>
#include <cmath>
#include <map>

#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::DrawList;
using raster::ItemId;

// --- offset and texel ---

using ChannelSum = std::function<ItemId(const Channel&, std::uint64_t, std::uint64_t)>;

/// A blend per channel.
StagedDevice withBlend(const std::vector<Channel>& channels, const ChannelSum& sum) {
  return withStage(&StagedDevice::blend, [=](const DrawList&, ItemId offset, ItemId texel) {
    return idOf(channels, [&](const Channel& channel) {
      return sum(channel, std::uint64_t{channel.of(offset)}, std::uint64_t{channel.of(texel)});
    });
  });
}

std::vector<Variant> modulations(const raster::IdFormat& format) {
  const auto product = [](const Channel& channel, std::uint64_t offset, std::uint64_t texel) {
    const std::uint64_t largest = channel.largest();
    return static_cast<ItemId>((offset * texel + largest / 2) / largest);
  };
  const std::vector<Channel> channels = channelsOf(format), colours = colourChannelsOf(format);
  std::vector<Variant> variants{{"", withBlend(colours, product), colours}};
  if (channels.size() != colours.size()) variants.push_back({"as one number", withBlend(channels, product), channels});
  return variants;
}

/// Wrong overflow of a channel.
std::vector<Fault> additions(const DrawList& list) {
  const auto clampedSum = [](const Channel& channel, std::uint64_t offset, std::uint64_t texel) {
    return static_cast<ItemId>(std::min<std::uint64_t>(offset + texel, channel.largest()));
  };
  const auto wrappedSum = [](const Channel& channel, std::uint64_t offset, std::uint64_t texel) {
    return static_cast<ItemId>((offset + texel) & channel.largest());
  };
  if (list.blend == raster::Blend::IntegerAdd)
    return {{"clamp instead of integer add",
             "add whole item IDs modulo 2^m: a colour blend unit clamps channels",
             {{"", withBlend(colourChannelsOf(list.format), clampedSum)}}}};
  if (list.blend != raster::Blend::ClampedAdd) return {};
  const auto carried = [](const DrawList& drawn, ItemId offset, ItemId texel) {
    return raster::blend(drawn.format, raster::Blend::IntegerAdd, offset, texel);
  };
  return {{"wrap instead of clamp",
           "clamp each channel's sum to its maximum: look for integer formats, or shaders that add",
           {{"", withBlend(channelsOf(list.format), wrappedSum)}}},
          {"carry across channels",
           "add each channel separately: look for shaders that add whole item IDs",
           {{"", withStage(&StagedDevice::blend, carried)}}}};
}

// --- offsets ---

/// The number of elements that a draw distinguishes.
ItemId elementsOf(const DrawList& list, const raster::Draw& draw) {
  if (!draw.indexMap) return 1;
  const std::vector<ItemId>& ids = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)].ids;
  return *std::max_element(ids.begin(), ids.end()) + 1;
}

/// Packs offsets in their order: each surface starts right after the elements of the one before.
void packOffsets(DrawList& list) {
  std::map<ItemId, ItemId> elements;
  for (const raster::Draw& draw : list.draws)
    elements[draw.offset] = std::max(elements[draw.offset], elementsOf(list, draw));
  std::map<ItemId, ItemId> packed;
  ItemId next = 0;
  for (const auto& [offset, count] : elements) {
    packed[offset] = next;
    next += count;
  }
  for (raster::Draw& draw : list.draws) draw.offset = packed[draw.offset];
}

/// Offsets as flat colours in the vertex buffer. The backend writes the offset of each triangle to its corner
/// `written`, and the device reads corner `read`. A vertex keeps its last write; a vertex without one holds the offset
/// of the last triangle that uses it. Each triangle becomes its own draw.
void readOffsetsFrom(DrawList& list, std::size_t written, std::size_t read) {
  std::vector<ItemId> colours(list.positions.size());
  std::vector<raster::Draw> triangles;
  for (const raster::Draw& draw : list.draws)
    for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3) {
      triangles.push_back(draw);
      triangles.back().first = first;
      triangles.back().count = 3;
      for (std::uint32_t k = 0; k < 3; ++k) colours[list.indices[first + k]] = draw.offset;
    }
  for (const raster::Draw& triangle : triangles) colours[list.indices[triangle.first + written]] = triangle.offset;
  for (raster::Draw& triangle : triangles) triangle.offset = colours[list.indices[triangle.first + read]];
  list.draws = triangles;
}

Variant provokingVertex(const std::string& name, std::size_t written, std::size_t read) {
  return {name, withStage(&StagedDevice::upload, [=](DrawList& list) { readOffsetsFrom(list, written, read); })};
}

// --- fragment and target ---

/// Blends colours into the target, which starts as the background; the fourth channel is alpha. Without alpha, or with
/// additive blending, the picture is correct or all background, which does not reveal blending.
std::vector<Variant> targetBlends(const raster::IdFormat& format) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  if (channels.size() < 4) return {};
  std::vector<Variant> variants;
  for (const bool isPremultiplied : {false, true}) {
    const auto store = [=](ItemId stored, ItemId fragment) {
      const double opaque = channels[3].largest(), alpha = channels[3].of(fragment) / opaque;
      return idOf(channels, [&](const Channel& channel) {
        const double source = channel.of(fragment), target = channel.of(stored), largest = channel.largest();
        const double sum = (isPremultiplied ? 1 : alpha) * source + (1 - alpha) * target;
        return std::min(std::nearbyint(sum), largest);
      });
    };
    variants.push_back(
        {isPremultiplied ? "by premultiplied alpha" : "by alpha", withStage(&StagedDevice::store, store), channels});
  }
  return variants;
}

}  // namespace

std::vector<Fault> blendFaults(const TestVector& vector) {
  const DrawList& list = vector.list;
  std::vector<Fault> faults{{"modulate instead of add",
                             "set the texture environment to add: the default of OpenGL multiplies",
                             modulations(list.format)}};
  for (Fault& fault : additions(list)) faults.push_back(std::move(fault));
  faults.push_back({"offset not aligned",
                    "the offset of a surface is its number << k, for any number of elements",
                    {{"", withStage(&StagedDevice::upload, packOffsets)}}});
  faults.push_back(
      {"colour from the wrong provoking vertex",
       "flat attributes come from one corner: OpenGL takes the last by default, Vulkan the first",
       {provokingVertex("the last instead of the first", 0, 2), provokingVertex("the first instead of the last", 2, 0),
        provokingVertex("the second instead of the first", 0, 1),
        provokingVertex("the second instead of the last", 2, 1)}});
  faults.push_back({"blending left on",
                    "turn blending off for the item buffer: each fragment replaces the stored item ID",
                    targetBlends(list.format)});
  return faults;
}

}  // namespace hemitex::reference
