/// Assembly: the triangles of strips, fans, restarts and instances (docs/item-buffers.md, "assembly"). Renderers draw
/// assembled lists, which have triangles of three indices and draws without instances.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "raster/interface/draw_list.h"

namespace hemitex::raster {

/// The triangles of a draw, as vertices in the order of the rules.
std::vector<std::array<std::uint32_t, 3>> trianglesOf(const DrawList& list, const Draw& draw);

/// The index that ends a strip, a fan or a triangle: the largest one of its bits.
inline std::uint32_t restartIndex(const DrawList& list) { return list.indexBits == 16 ? 0xffff : 0xffffffff; }

/// Pairs (offset of a draw, triangle in the draw) as numbers of 32 bits. All pairs of draws count from 0, in the order
/// of offsets; the background stays, and all other pairs are `backId`.
class PairNumbers {
 public:
  explicit PairNumbers(const DrawList& list);

  /// The number of the first triangle of the draws with an offset.
  ItemId baseOf(ItemId offset) const { return ranges_.at(offset).base; }
  /// A pair is offset * 2^32 + triangle; the background is 2^64 - 1.
  ItemId numberOf(std::uint64_t pair) const;
  std::uint64_t pairOf(ItemId number) const;

 private:
  struct Range {
    ItemId base = 0;
    std::uint32_t triangles = 0;
  };
  std::map<ItemId, Range> ranges_;  ///< by offset
};

}  // namespace hemitex::raster
