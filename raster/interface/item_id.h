/// Item IDs: the value of each pixel of an item buffer, and how a blend unit computes it (docs/item-buffers.md,
/// "blend").
///
/// An item ID of m bits consists of channels, from the least significant bit up. Blending hardware adds offset and
/// texel channel by channel and clamps each sum, so that no carry leaves a channel. Therefore item IDs are aligned
/// (Nielsen and Christensen 2002, section 3.2): the low k bits hold the element and the other bits the surface. An
/// offset `surface << k` plus an index below 2^k then overflows no channel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemitex::raster {

using ItemId = std::uint32_t;

/// The channels of an item ID: their widths in bits, least significant first; the sum is 2 to 32 bits. By default that
/// of usual colour buffers, r8g8b8a8.
struct IdFormat {
  std::vector<int> channelBits = {8, 8, 8, 8};
  bool operator==(const IdFormat&) const = default;
};

/// The format r5g6b5, r8g8b8, r8g8b8a8, r10g10b10a2 or r32ui; nothing for other names.
std::optional<IdFormat> formatNamed(std::string_view name);
/// The names that formatNamed accepts, narrowest format first.
std::vector<std::string> formatNames();

/// m, the number of bits of an item ID.
int idBits(const IdFormat& format);

/// The item ID of a pixel that no triangle covers: all m bits set.
ItemId backgroundId(const IdFormat& format);
/// The item ID of the back of a blocker: backgroundId - 1.
ItemId backId(const IdFormat& format);

enum class Blend {
  ClampedAdd,  ///< min(offset + texel, maximum) per channel, as fixed-function hardware does
  IntegerAdd,  ///< sum of whole item IDs modulo 2^m: the hypothetical hardware of the paper
  Replace,     ///< the texel alone: for unique index maps
};

/// The item ID of a textured fragment. `offset` and `texel` have m bits.
ItemId blend(const IdFormat& format, Blend operation, ItemId offset, ItemId texel);

}  // namespace hemitex::raster
