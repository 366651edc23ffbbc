/// Sums of pixels where they are drawn: what a renderer may offer besides item buffers, so that only sums are read
/// back. A sum is of integers, so that it does not depend on the order of the pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "raster/interface/face.h"

namespace hemitex::raster {

/// The slots of item IDs, into which their pixels are summed: the rules of radiosity::IdLookup as plain arrays.
struct SlotTable {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// The item IDs number * 2^bits + [0, count).
  struct Block {
    std::uint32_t count = 0;
    std::uint32_t first = 0;     ///< of consecutive slots, without a table
    std::uint32_t table = none;  ///< place of the slots in `slots`
  };

  int bits = 0;  ///< 0 to 31
  ItemId backId = 0;
  std::uint32_t back = 0;  ///< the slot of backId; the next one is that of all IDs without a slot, and the last
  std::vector<Block> blocks = {};
  std::vector<std::uint32_t> slots = {};  ///< those above back + 1 mean back + 1

  std::size_t count() const { return std::size_t{back} + 2; }
};

/// The slots of a view whose sums are not 0.
struct SlotSums {
  std::vector<std::uint32_t> slots;  ///< ascending
  std::vector<std::uint64_t> sums;   ///< one per slot
};

/// What is summed to one result.
struct SummedView {
  std::span<const Face> faces;
  std::span<const std::size_t> weights;    ///< one table per face: numbers of PixelSums::addWeights
  std::span<const std::uint32_t> skipped;  ///< see ItemBufferRenderer::draw
};

class PixelSums {
 public:
  virtual ~PixelSums() = default;

  /// Keeps the weights of the pixels of a scissor rectangle, row-major, as running sums: before each pixel, and after
  /// the last. All sums of a view must stay below 2^63. Returns their number, or `none` if there is no room for them.
  virtual std::size_t addWeights(std::span<const std::uint64_t> before) = 0;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// Draws and sums the pixels of each view. Many views at once take less time than one after the other.
  virtual std::vector<SlotSums> sum(std::span<const SummedView> views) = 0;
};

}  // namespace hemitex::raster
