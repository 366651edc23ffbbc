// blend and the formats, over whole ranges of item IDs.
#include "raster/interface/item_id.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

using namespace hemitex::raster;

namespace {

const IdFormat rgb8{{8, 8, 8}};

}  // namespace

TEST_CASE("formatNamed gives the widths that the names contain", "[item_id]") {
  for (const std::string& name : formatNames()) {
    int bits = 0;  // the sum of the digits in the name: r5g6b5 has 5 + 6 + 5 bits
    int number = 0;
    for (const char c : name + " ") {
      if (c >= '0' && c <= '9') {
        number = 10 * number + (c - '0');
      } else {
        bits += number;
        number = 0;
      }
    }
    INFO(name);
    REQUIRE(formatNamed(name));
    CHECK(idBits(*formatNamed(name)) == bits);
  }
  CHECK_FALSE(formatNamed("r9g9b9e5"));
}

TEST_CASE("backgroundId and backId are the two largest item IDs", "[item_id]") {
  CHECK(backgroundId({{8, 8, 8}}) == 0xffffffu);
  CHECK(backId({{8, 8, 8}}) == 0xfffffeu);
  CHECK(backgroundId({{32}}) == 0xffffffffu);
  CHECK(backId({{10, 10, 10, 2}}) == 0xfffffffeu);
  CHECK(backgroundId({{5, 6, 5}}) == 0xffffu);
}

TEST_CASE("blend with ClampedAdd saturates each channel alone, for all byte pairs of each channel", "[item_id]") {
  for (int channel = 0; channel < 3; ++channel) {
    const int shift = 8 * channel;
    // Neighbouring channels hold 0x12 + 0x34 = 0x46: a carry or a borrow would show there.
    const ItemId others = 0x121212u & ~(0xffu << shift);
    const ItemId otherTexels = 0x343434u & ~(0xffu << shift);
    const ItemId expectedOthers = 0x464646u & ~(0xffu << shift);
    bool holds = true;
    for (ItemId offset = 0; offset < 256; ++offset)
      for (ItemId texel = 0; texel < 256; ++texel) {
        const ItemId id = blend(rgb8, Blend::ClampedAdd, others | offset << shift, otherTexels | texel << shift);
        holds &= id == (expectedOthers | std::min<ItemId>(offset + texel, 255) << shift);
      }
    CHECK(holds);
  }
}

TEST_CASE("blend with ClampedAdd saturates channels of different widths at their own maxima", "[item_id]") {
  const IdFormat format{{5, 6, 5}};
  bool holds = true;
  for (ItemId a = 0; a < 64; ++a)
    for (ItemId b = 0; b < 64; ++b) {
      const ItemId red = std::min<ItemId>((a & 31) + (b & 31), 31);
      const ItemId green = std::min<ItemId>(a + b, 63);
      const auto id = [](ItemId c) { return (c & 31) | c << 5 | (c & 31) << 11; };
      holds &= blend(format, Blend::ClampedAdd, id(a), id(b)) == (red | green << 5 | red << 11);
    }
  CHECK(holds);
}

TEST_CASE("blend with IntegerAdd carries across channels and wraps at the width of the item ID", "[item_id]") {
  CHECK(blend(rgb8, Blend::IntegerAdd, 0x0000ff, 1) == 0x000100);
  CHECK(blend(rgb8, Blend::IntegerAdd, 0xffffff, 2) == 1);
  CHECK(blend({{32}}, Blend::IntegerAdd, 0xffffffff, 2) == 1);
  CHECK(blend(rgb8, Blend::Replace, 0x123456, 0x654321) == 0x654321);
}

TEST_CASE("blend of an aligned offset and an index is their bitwise or, for all 24-bit item IDs with k = 12",
          "[item_id]") {
  bool holds = true;
  for (ItemId surface = 0; surface < 4096; ++surface)
    for (ItemId element = 0; element < 4096; ++element) {
      const ItemId id = surface << 12 | element;
      holds &= blend(rgb8, Blend::ClampedAdd, surface << 12, element) == id;
      holds &= blend(rgb8, Blend::IntegerAdd, surface << 12, element) == id;
    }
  CHECK(holds);
}

TEST_CASE("blend with ClampedAdd loses the two item IDs of an unaligned offset that need a carry", "[item_id]") {
  // Offset 254 and a 2 x 2 index map: the item IDs should be 254, 255, 256, 257. The last two carry out of the low
  // channel, which the clamp prevents. Both become 255: two elements are lost, and a third gets all their pixels.
  std::vector<ItemId> clamped, added;
  for (ItemId texel = 0; texel < 4; ++texel) {
    clamped.push_back(blend(rgb8, Blend::ClampedAdd, 254, texel));
    added.push_back(blend(rgb8, Blend::IntegerAdd, 254, texel));
  }
  CHECK(added == std::vector<ItemId>{254, 255, 256, 257});
  CHECK(clamped == std::vector<ItemId>{254, 255, 255, 255});
}

TEST_CASE("blend with ClampedAdd equals the integer sum exactly where no channel overflows", "[item_id]") {
  // All offsets of 16 bits with the largest 8-bit index map: item IDs whose low byte carries are lost.
  const IdFormat format{{8, 8}};
  bool holds = true;
  for (ItemId offset = 0; offset < 65280; ++offset)
    for (ItemId texel = 0; texel < 256; ++texel) {
      const bool carries = (offset & 255) + texel > 255;
      const bool equal =
          blend(format, Blend::ClampedAdd, offset, texel) == blend(format, Blend::IntegerAdd, offset, texel);
      holds &= equal == !carries;
    }
  CHECK(holds);
}
