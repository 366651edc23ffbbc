/// Words as colours: what hardware that knows no words makes of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::reference {

/// Bits [shift, shift + bits) of a word.
struct Channel {
  int shift = 0;
  int bits = 0;

  raster::Word largest() const { return static_cast<raster::Word>((std::uint64_t{1} << bits) - 1); }
  raster::Word of(raster::Word word) const { return (word >> shift) & largest(); }
};

/// The channels of a format, least significant first.
inline std::vector<Channel> channelsOf(const raster::WordFormat& format) {
  std::vector<Channel> channels;
  int shift = 0;
  for (const int bits : format.channelBits) {
    channels.push_back({shift, bits});
    shift += bits;
  }
  return channels;
}

/// The channels of the colour that holds a word: a word of one channel of 32 bits may travel as four bytes.
inline std::vector<Channel> colourChannelsOf(const raster::WordFormat& format) {
  return channelsOf(format.channelBits == std::vector<int>{32} ? raster::WordFormat{{8, 8, 8, 8}} : format);
}

/// The word whose channels are value(channel), the others zero.
template <typename Value>
raster::Word wordOf(std::span<const Channel> channels, const Value& value) {
  raster::Word word = 0;
  for (const Channel& channel : channels) word |= value(channel) << channel.shift;
  return word;
}

/// Whether two words differ by at most one in each channel.
inline bool isClose(std::span<const Channel> channels, raster::Word a, raster::Word b) {
  for (const Channel& channel : channels) {
    const raster::Word x = channel.of(a), y = channel.of(b);
    if (x > y ? x - y > 1 : y - x > 1) return false;
  }
  return true;
}

}  // namespace hemitex::reference
