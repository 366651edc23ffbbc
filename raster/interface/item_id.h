/// Item IDs: the numbers that an item buffer holds, one a pixel, and how a blend unit makes them (raster rules, 7).
///
/// An item ID of m bits is split into channels from the least significant bit up. Blending hardware knows colours, not
/// numbers: it adds offset and texel channel by channel and clamps each sum, so no carry leaves a channel. Hence the
/// alignment of Nielsen and Christensen (2002, section 3.2): the low k bits hold the element, the bits above hold the
/// surface, and an offset `surface << k` plus an index below 2^k never overflows a channel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemitex::raster {

using ItemId = std::uint32_t;

/// How an item ID is cut into channels: their widths in bits, least significant first; 1 to 32 bits in all.
struct IdFormat {
  std::vector<int> channelBits;
  bool operator==(const IdFormat&) const = default;
};

/// r5g6b5, r8g8b8, r8g8b8a8, r10g10b10a2 or r32ui; nothing for another name.
std::optional<IdFormat> formatNamed(std::string_view name);
/// The names that formatNamed knows, narrowest format first.
std::vector<std::string> formatNames();

/// m, the number of bits of an item ID.
int idBits(const IdFormat& format);

/// The pixel that nothing covers: all m bits set.
ItemId backgroundId(const IdFormat& format);
/// The pixel that shows the back of a blocker: all ones less one.
ItemId backId(const IdFormat& format);

enum class Blend {
  ClampedAdd,  ///< each channel min(offset + texel, its maximum), as fixed-function hardware does
  IntegerAdd,  ///< whole item IDs modulo 2^m: the hypothetical hardware of the paper
  Replace,     ///< the texel alone: unique index maps
};

/// The item ID of a textured fragment. `offset` and `texel` have m bits.
ItemId blend(const IdFormat& format, Blend operation, ItemId offset, ItemId texel);

/// An element of a surface: what an aligned item ID says.
struct SurfaceElement {
  std::uint32_t surface;
  std::uint32_t element;
  bool operator==(const SurfaceElement&) const = default;
};

/// `surface << indexBits | element`; the element is below 2^indexBits, and the surface fits above it.
ItemId pack(SurfaceElement value, int indexBits);
/// The inverse of pack: a shift and a mask.
SurfaceElement unpack(ItemId id, int indexBits);

}  // namespace hemitex::raster
