/// Item IDs as colours, which is how hardware without integer formats treats them.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::reference {

/// Bits [shift, shift + bits) of an item ID.
struct Channel {
  int shift = 0;
  int bits = 0;

  raster::ItemId largest() const { return static_cast<raster::ItemId>((std::uint64_t{1} << bits) - 1); }
  raster::ItemId of(raster::ItemId id) const { return (id >> shift) & largest(); }
};

/// The channels of a format, least significant first.
inline std::vector<Channel> channelsOf(const raster::IdFormat& format) {
  std::vector<Channel> channels;
  int shift = 0;
  for (const int bits : format.channelBits) {
    channels.push_back({shift, bits});
    shift += bits;
  }
  return channels;
}

/// The channels of the colour that holds an item ID. A backend may pass an item ID of one 32-bit channel as four bytes.
inline std::vector<Channel> colourChannelsOf(const raster::IdFormat& format) {
  return channelsOf(format.channelBits == std::vector<int>{32} ? raster::IdFormat{{8, 8, 8, 8}} : format);
}

/// The item ID whose channels are value(channel), rounded to whole numbers, the others zero.
template <typename Value>
raster::ItemId idOf(std::span<const Channel> channels, const Value& value) {
  raster::ItemId id = 0;
  for (const Channel& channel : channels) {
    const double number = value(channel);
    id |= static_cast<raster::ItemId>(std::nearbyint(number)) << channel.shift;
  }
  return id;
}

/// Whether two item IDs differ by at most one in each channel.
inline bool isClose(std::span<const Channel> channels, raster::ItemId a, raster::ItemId b) {
  for (const Channel& channel : channels) {
    const raster::ItemId x = channel.of(a), y = channel.of(b);
    if (x > y ? x - y > 1 : y - x > 1) return false;
  }
  return true;
}

}  // namespace hemitex::reference
