/// Faults of item IDs in memory: the order of channels and bytes, lost bits, the length of rows, and conversions of
/// colours.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::DrawList;
using raster::ItemId;

StagedDevice withTexels(const IdChange& change) {
  return withStage(&StagedDevice::upload, [=](DrawList& list) {
    for (raster::IndexMap& map : list.indexMaps)
      for (ItemId& id : map.ids) id = change(id);
  });
}

/// Changes offsets and back item IDs, which backends pass in the same way.
StagedDevice withOffsets(const IdChange& change) {
  return withStage(&StagedDevice::upload, [=](DrawList& list) {
    for (raster::Draw& draw : list.draws) {
      draw.offset = change(draw.offset);
      if (draw.back) draw.back = change(*draw.back);
    }
  });
}

/// A change in each place that holds item IDs; `input` is that of index maps and offsets.
std::vector<Variant> withAny(const IdChange& change, const IdChange& input) {
  return {
      {"in item ID files", withIds(change)}, {"in index maps", withTexels(input)}, {"in offsets", withOffsets(input)}};
}

std::vector<Variant> withAny(const IdChange& change) { return withAny(change, change); }

// --- channels ---

using Order = std::vector<std::size_t>;

/// Exchanges and rotations of the first three channels, and rotations of four, that keep the widths of channels. The
/// first is BGRA for RGBA. The reverse order of four channels is missing, because it is a byte order.
std::vector<Order> channelOrders(const std::vector<Channel>& channels) {
  std::vector<Order> orders{{2, 1, 0}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}};
  if (channels.size() < 3) orders.clear();
  if (channels.size() == 4) {
    for (Order& order : orders) order.push_back(3);
    orders.insert(orders.end(), {{1, 2, 3, 0}, {3, 0, 1, 2}});
  }
  const auto changesWidths = [&](const Order& order) {
    for (std::size_t k = 0; k < order.size(); ++k)
      if (channels[order[k]].bits != channels[k].bits) return true;
    return false;
  };
  orders.erase(std::remove_if(orders.begin(), orders.end(), changesWidths), orders.end());
  return orders;
}

std::vector<Variant> swaps(const raster::IdFormat& format, StagedDevice (*changed)(const IdChange&)) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  std::vector<Variant> variants;
  for (const Order& order : channelOrders(channels)) {
    std::string name;
    for (const std::size_t channel : order) name += "RGBA"[channel];
    variants.push_back({name, changed([=](ItemId id) {
                          ItemId swapped = 0;
                          for (std::size_t k = 0; k < order.size(); ++k)
                            swapped |= channels[order[k]].of(id) << channels[k].shift;
                          return swapped;
                        })});
  }
  return variants;
}

std::vector<Variant> byteOrders(const raster::IdFormat& format) {
  const auto reversed = [](ItemId id) { return id << 24 | (id & 0xff00) << 8 | (id >> 8 & 0xff00) | id >> 24; };
  // Hardware drops the bits beyond the size of an item ID.
  const ItemId all = raster::backgroundId(format);
  const auto cut = [=](ItemId id) { return reversed(id) & all; };
  return withAny(reversed, cut);
}

// --- numbers and constants ---

/// The nearest number of 24 significant bits, at most 2^32 - 1.
ItemId throughBinary32(ItemId id) {
  return static_cast<ItemId>(std::min(static_cast<double>(static_cast<float>(id)), 4294967295.0));
}

/// The same on a processor that reads 2^32, which is too large, as 0.
ItemId throughBinary32WithOverflow(ItemId id) {
  return static_cast<ItemId>(static_cast<std::uint64_t>(static_cast<float>(id)));
}

std::vector<Variant> throughFloats() {
  std::vector<Variant> variants = withAny(throughBinary32);
  variants.push_back({"in item ID files, 2^32 read as 0", withIds(throughBinary32WithOverflow)});
  return variants;
}

/// Item IDs as half floats of 11 bits: above 65504 there is infinity, which is read as all ones.
/// Empty if all draws are there: nothing is left of them.
std::vector<Variant> throughHalfFloats(const DrawList& list) {
  if (std::none_of(list.draws.begin(), list.draws.end(), [](const raster::Draw& draw) { return draw.offset < 65520; }))
    return {};
  const ItemId all = raster::backgroundId(list.format);
  return withAny([=](ItemId id) {
    const double unit = std::ldexp(1.0, std::max(0, std::ilogb(std::max<double>(id, 1)) - 10));
    const double rounded = std::nearbyint(id / unit) * unit;
    return rounded < 65520 ? static_cast<ItemId>(rounded) : all;
  });
}

/// An item ID between three equal ones, computed in floats just below it and truncated. Which pixels are rounded so
/// depends on the device: the item ID is off by at most one.
std::vector<Variant> interpolatedIds(const raster::IdFormat& format) {
  const std::vector<Channel> number{{0, raster::idBits(format)}};
  const ItemId background = raster::backgroundId(format);
  const auto below = [=](ItemId id) { return id == 0 || id == background ? id : id - 1; };
  return {{"of the draw", withOffsets(below), number, true}, {"of the fragment", withIds(below), number, true}};
}

/// Item IDs in 8 or 16 bits, in each place that holds them.
std::vector<Variant> fewerBits() {
  std::vector<Variant> variants;
  for (const int bits : {8, 16})
    for (const bool isClamped : {false, true}) {
      const ItemId largest = (ItemId{1} << bits) - 1;
      const auto cut = [=](ItemId id) { return isClamped ? std::min(id, largest) : id & largest; };
      for (Variant& variant : withAny(cut)) {
        variant.name += ", " + std::to_string(bits) + (isClamped ? " bits, clamped" : " bits");
        variants.push_back(std::move(variant));
      }
    }
  return variants;
}

/// The item ID whose fourth channel is all ones and the others zero; nothing without a fourth channel.
std::optional<ItemId> opaqueBlack(const raster::IdFormat& format) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  if (channels.size() < 4) return {};
  return channels[3].largest() << channels[3].shift;
}

std::vector<Variant> opaqueAlphas(const raster::IdFormat& format) {
  const std::optional<ItemId> alpha = opaqueBlack(format);
  if (!alpha) return {};
  return withAny([=](ItemId id) { return id | *alpha; });
}

std::vector<Variant> otherBackgrounds(const raster::IdFormat& format) {
  const ItemId background = raster::backgroundId(format);
  const auto with = [=](ItemId clear) { return withIds([=](ItemId id) { return id == background ? clear : id; }); };
  std::vector<Variant> variants{{"zeros", with(0)}};
  if (const std::optional<ItemId> black = opaqueBlack(format)) variants.push_back({"opaque black", with(*black)});
  return variants;
}

/// Colours times their alpha, the fourth channel. Formats without one are uploaded as four bytes, whose alpha is zero.
std::vector<Variant> premultiplications(const raster::IdFormat& format) {
  std::vector<Channel> channels = colourChannelsOf(format);
  if (channels.size() < 4) channels = channelsOf({{8, 8, 8, 8}});
  std::vector<Variant> variants = withAny([=](ItemId id) {
    const double alpha = channels[3].of(id) / static_cast<double>(channels[3].largest());
    return idOf(channels, [&](const Channel& channel) {
      return (channel.shift == channels[3].shift ? 1 : alpha) * channel.of(id);
    });
  });
  for (Variant& variant : variants) variant.rounded = channels;
  return variants;
}

// --- rows ---

using Bytes = std::vector<std::uint8_t>;

/// A memory layout: a pixel has `bytes` bytes, and rows start at multiples of `alignment`.
struct Layout {
  std::size_t bytes, alignment;

  std::size_t rowBytes(int width) const {
    const std::size_t tight = static_cast<std::size_t>(width) * bytes;
    return (tight + alignment - 1) / alignment * alignment;
  }
};

/// Writes an image of `width` columns in one layout and reads it in the other, with zeros beyond the end.
void reinterpret(std::vector<ItemId>& ids, int width, const Layout& written, const Layout& read) {
  const std::size_t columns = static_cast<std::size_t>(width), rows = ids.size() / columns;
  Bytes memory(rows * std::max(written.rowBytes(width), read.rowBytes(width)));
  const auto at = [&](const Layout& layout, std::size_t pixel, std::size_t byte) -> std::uint8_t& {
    return memory[pixel / columns * layout.rowBytes(width) + pixel % columns * layout.bytes + byte];
  };
  for (std::size_t pixel = 0; pixel < ids.size(); ++pixel)
    for (std::size_t byte = 0; byte < written.bytes; ++byte)
      at(written, pixel, byte) = static_cast<std::uint8_t>(ids[pixel] >> (8 * byte));
  for (std::size_t pixel = 0; pixel < ids.size(); ++pixel) {
    ids[pixel] = 0;
    for (std::size_t byte = 0; byte < read.bytes; ++byte) ids[pixel] |= ItemId{at(read, pixel, byte)} << (8 * byte);
  }
}

/// Rows of item ID files or index maps that only the writer or only the reader pads. Pixels have four bytes, or the
/// minimum for an item ID.
std::vector<Variant> paddings(const raster::IdFormat& format) {
  std::vector<Variant> variants;
  const auto minBytes = static_cast<std::size_t>((raster::idBits(format) + 7) / 8);
  const auto add = [&](const Layout& layout, bool isWritten) {
    const Layout tight{layout.bytes, 1};
    const Layout written = isWritten ? layout : tight, read = isWritten ? tight : layout;
    const std::string name = std::to_string(layout.alignment) + " bytes, pixels of " + std::to_string(layout.bytes) +
                             (isWritten ? ", written" : ", read");
    const StagedDevice ids = withReadBack(
        [=](const raster::Face&, raster::ItemBuffer& buffer) { reinterpret(buffer.ids, buffer.width, written, read); });
    const StagedDevice maps = withStage(&StagedDevice::upload, [=](DrawList& list) {
      for (raster::IndexMap& map : list.indexMaps) reinterpret(map.ids, map.width, written, read);
    });
    variants.push_back({"item ID files to " + name, ids});
    variants.push_back({"index maps to " + name, maps});
  };
  for (const std::size_t bytes : std::set{std::size_t{4}, minBytes})
    for (const std::size_t alignment : {4u, 8u, 16u, 64u, 256u})
      if (alignment % bytes != 0 || alignment > bytes)
        for (const bool isWritten : {true, false}) add({bytes, alignment}, isWritten);
  return variants;
}

// --- colours ---

double toLinear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double toEncoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// A curve on all channels but the fourth, which is alpha; values are from 0 to 1.
IdChange onColours(const std::vector<Channel>& channels, const std::function<double(double)>& curve) {
  return [=](ItemId id) {
    return idOf(channels, [&](const Channel& channel) {
      const double value = channel.of(id), largest = channel.largest();
      const bool isAlpha = channels.size() == 4 && channel.shift == channels[3].shift;
      return isAlpha ? value : curve(value / largest) * largest;
    });
  };
}

/// The transfer functions of IEC 61966-2-1.
std::vector<Variant> colourEncodings(const raster::IdFormat& format) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  return {{"index maps decoded", withTexels(onColours(channels, toLinear)), channels},
          {"target encoded", withIds(onColours(channels, toEncoded)), channels}};
}

/// Curves that make a bright scene fit the display.
std::vector<Variant> toneMappings(const raster::IdFormat& format) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  const std::vector<std::pair<std::string, double (*)(double)>> curves{
      {"x/(1 + x)", [](double x) { return x / (1 + x); }},
      {"1 - exp(-x)", [](double x) { return 1 - std::exp(-x); }},
      {"filmic", [](double x) { return std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)); }}};
  std::vector<Variant> variants;
  for (const auto& [name, curve] : curves)
    for (const bool isEncoded : {false, true}) {
      const auto shown = [=, curve = curve](double x) { return isEncoded ? toEncoded(curve(x)) : curve(x); };
      variants.push_back({name + (isEncoded ? ", then sRGB" : ""), withIds(onColours(channels, shown)), channels});
    }
  return variants;
}

/// The order in which the pixels of a 4 x 4 block round up (ordered dithering).
constexpr std::array<int, 16> ditherMatrix{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};

/// A channel dithered to `bits` bits and read back at its own size. A channel of `bits` bits is converted from 8 bits.
ItemId dithered(const Channel& channel, ItemId value, int bits, double threshold) {
  const double largest = channel.largest(), fewer = (1 << bits) - 1;
  if (channel.bits < bits || (channel.bits == bits && bits >= 8)) return value;
  const double colour = channel.bits == bits ? std::nearbyint(value / largest * 255) / 255 : value / largest;
  return static_cast<ItemId>(std::nearbyint(std::floor(colour * fewer + threshold) / fewer * largest));
}

std::vector<Variant> ditherings(const raster::IdFormat& format) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  std::vector<Variant> variants;
  for (const std::vector<int>& bits : {std::vector{8, 8, 8, 8}, {5, 6, 5, 8}, {5, 5, 5, 1}, {4, 4, 4, 4}}) {
    if (channels.size() > bits.size()) continue;
    const StagedDevice device = withReadBack([=](const raster::Face& face, raster::ItemBuffer& buffer) {
      for (std::size_t pixel = 0; pixel < buffer.ids.size(); ++pixel) {
        const glm::ivec2 at = pixelAt(face.scissor, pixel);
        const double threshold = (ditherMatrix[static_cast<std::size_t>(at.y % 4 * 4 + at.x % 4)] + 0.5) / 16;
        std::size_t k = 0;
        const ItemId id = buffer.ids[pixel];
        buffer.ids[pixel] = idOf(
            channels, [&](const Channel& channel) { return dithered(channel, channel.of(id), bits[k++], threshold); });
      }
    });
    std::string name;
    for (std::size_t k = 0; k < channels.size(); ++k) name += (k == 0 ? "" : "-") + std::to_string(bits[k]);
    variants.push_back({name, device, channels});
  }
  return variants;
}

}  // namespace

std::vector<Fault> memoryFaults(const TestVector& vector) {
  const raster::IdFormat& format = vector.list.format;
  return {
      {"channels swapped in the texture (BGRA)",
       "the least significant channel comes first: look at the format of uploads", swaps(format, withTexels)},
      {"channels swapped in the offset (BGRA)",
       "the least significant channel comes first: look at how colours are passed", swaps(format, withOffsets)},
      {"channels swapped in the target (BGRA)",
       "the least significant channel comes first: look at the format of the target and of reading back",
       swaps(format, withIds)},
      {"byte order", "arrays are little-endian: write and read item IDs with their least significant byte first",
       byteOrders(format)},
      {"item IDs through binary32", "a binary32 holds 24 bits: pass larger item IDs as integers or as channels",
       throughFloats()},
      {"item IDs through half floats", "a half float holds 11 bits: ask for integer formats, or for 8 bits per channel",
       throughHalfFloats(vector.list)},
      {"item ID interpolated", "declare the item ID flat, and pass it as an integer: interpolated, it is rounded down",
       interpolatedIds(format)},
      {"item IDs cut to fewer bits", "hold item IDs in as many bits as their format has: look at integer formats",
       fewerBits()},
      {"premultiplied alpha",
       "the fourth channel is a part of the item ID: turn the multiplication of colours by alpha off",
       premultiplications(format)},
      {"alpha forced to opaque",
       "the fourth channel is a part of the item ID: ask for formats with alpha, and write it", opaqueAlphas(format)},
      {"background not cleared", "clear the target to all ones, the background's item ID", otherBackgrounds(format)},
      {"padded rows", "rows have no padding: set pack and unpack alignment to 1, or copy row by row", paddings(format)},
      {"sRGB encoding", "ask for linear formats of textures and target, and turn framebuffer encoding off",
       colourEncodings(format)},
      {"tone mapping", "draw item IDs into a target of their own, after which no pass changes colours",
       toneMappings(format)},
      {"dithering", "turn dithering off, and ask for a target with the item ID's channels", ditherings(format)}};
}

}  // namespace hemitex::reference
