#include "raster/interface/item_id.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace hemitex::raster {
namespace {

struct NamedFormat {
  std::string_view name;
  IdFormat format;
};

std::vector<NamedFormat> namedFormats() {
  return {{"r5g6b5", {{5, 6, 5}}},
          {"r8g8b8", {{8, 8, 8}}},
          {"r8g8b8a8", {{8, 8, 8, 8}}},
          {"r10g10b10a2", {{10, 10, 10, 2}}},
          {"r32ui", {{32}}}};
}

ItemId clampedAdd(const IdFormat& format, ItemId offset, ItemId texel) {
  // Without common bits there are no carries. Aligned offsets always take this path.
  if ((offset & texel) == 0) return offset | texel;
  ItemId sum = 0;
  int shift = 0;
  for (const int bits : format.channelBits) {
    const std::uint64_t largest = (std::uint64_t{1} << bits) - 1;
    const std::uint64_t channel = ((offset >> shift) & largest) + ((texel >> shift) & largest);
    sum |= static_cast<ItemId>(std::min(channel, largest)) << shift;
    shift += bits;
  }
  return sum;
}

}  // namespace

std::optional<IdFormat> formatNamed(std::string_view name) {
  for (const NamedFormat& named : namedFormats())
    if (named.name == name) return named.format;
  return std::nullopt;
}

std::vector<std::string> formatNames() {
  std::vector<std::string> names;
  for (const NamedFormat& named : namedFormats()) names.emplace_back(named.name);
  return names;
}

int idBits(const IdFormat& format) { return std::accumulate(format.channelBits.begin(), format.channelBits.end(), 0); }

ItemId backgroundId(const IdFormat& format) { return static_cast<ItemId>((std::uint64_t{1} << idBits(format)) - 1); }

ItemId backId(const IdFormat& format) { return backgroundId(format) - 1; }

ItemId blend(const IdFormat& format, Blend operation, ItemId offset, ItemId texel) {
  switch (operation) {
    case Blend::ClampedAdd:
      return clampedAdd(format, offset, texel);
    case Blend::IntegerAdd:
      return (offset + texel) & backgroundId(format);
    case Blend::Replace:
      return texel;
  }
  assert(false);
  return 0;
}

}  // namespace hemitex::raster
