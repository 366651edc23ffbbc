#include "radiosity/form_factors/item_buffer_sum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <numeric>
#include <utility>

#include "raster/base/parallel.h"
#include "raster/kernels/run_kernels.h"

namespace hemitex::radiosity {
namespace {

using raster::ItemId;

/// Adds adjacent pixels, run by run. `before` holds the running sum of shares before each pixel, and after the last.
void addPixels(const IdLookup& slots, const ItemId* ids, const std::uint64_t* before, std::size_t count,
               SparseSums& sums) {
  assert(count > 0);
  constexpr std::size_t pixelsAtOnce = 4096;
  std::array<std::uint64_t, pixelsAtOnce / raster::changesAtOnce> changes;
  SlotFinder finder(slots);
  std::uint64_t begin = before[0];
  for (std::size_t pixel = 1; pixel < count; pixel += pixelsAtOnce) {
    const std::size_t some = std::min(pixelsAtOnce, count - pixel);
    raster::bestKernels<raster::RunKernels>().findChanges(ids + pixel, some, changes.data());
    for (std::size_t first = 0; first < some; first += raster::changesAtOnce)
      for (std::uint64_t ends = changes[first / raster::changesAtOnce]; ends != 0; ends &= ends - 1) {
        const std::size_t end = pixel + first + static_cast<std::size_t>(std::countr_zero(ends));
        sums.add(finder.of(ids[end - 1]), before[end] - begin);
        begin = before[end];
      }
  }
  sums.add(finder.of(ids[count - 1]), before[count] - begin);
}

/// Adds rows [firstRow, endRow) of a window.
void addRows(const IdLookup& slots, const Projection& projection, const Window& window,
             const raster::ItemBuffer& buffer, int firstRow, int endRow, SparseSums& sums) {
  const raster::Scissor& some = window.scissor;
  const raster::Scissor& whole = projection.faces[window.face].scissor;
  assert(buffer.width == some.width && buffer.height == some.height);
  assert(some.column >= whole.column && some.column + some.width <= whole.column + whole.width);
  assert(some.row >= whole.row && some.row + some.height <= whole.row + whole.height);
  if (some.width == 0) return;
  const std::uint64_t* const before = projection.sharesBefore[projection.faces[window.face].shares].data();
  const auto add = [&](int row, std::size_t count) {
    const auto first = static_cast<std::ptrdiff_t>(some.row - whole.row + row) * whole.width;
    addPixels(slots, buffer.ids.data() + static_cast<std::ptrdiff_t>(row) * some.width,
              before + first + (some.column - whole.column), count, sums);
  };
  const auto width = static_cast<std::size_t>(some.width);
  // If the window has the full width, rows are contiguous, and a run may continue in the next row.
  if (some.width == whole.width) return add(firstRow, width * static_cast<std::size_t>(endRow - firstRow));
  for (int row = firstRow; row < endRow; ++row) add(row, width);
}

using AllSums = std::span<SparseSums* const>;

/// Calls body(number) for the blocks of a group that any of the sums has, in ascending order.
template <typename Body>
void forEachBlock(AllSums all, std::size_t group, const Body& body) {
  std::uint64_t blocks = 0;
  for (const SparseSums* sums : all) blocks |= sums->blocksIn(group);
  for (; blocks != 0; blocks &= blocks - 1)
    body(static_cast<std::uint32_t>(group * SparseSums::blocksInGroup) +
         static_cast<std::uint32_t>(std::countr_zero(blocks)));
}

std::size_t elementsIn(AllSums all, std::size_t group) {
  std::size_t elements = 0;
  forEachBlock(all, group, [&](std::uint32_t number) {
    std::uint64_t touched = 0;
    for (SparseSums* sums : all)
      if (const SparseSums::Block* block = sums->find(number)) touched |= block->touched;
    elements += static_cast<std::size_t>(std::popcount(touched));
  });
  return elements;
}

/// Moves the shares of a group into a row, from `place` on.
void moveGroup(AllSums all, std::size_t group, std::size_t place, FormFactorRow& row) {
  std::vector<SparseSums::Block*> blocks;
  forEachBlock(all, group, [&](std::uint32_t number) {
    blocks.clear();
    std::uint64_t touched = 0;
    for (SparseSums* sums : all)
      if (SparseSums::Block* block = sums->find(number)) {
        blocks.push_back(block);
        touched |= block->touched;
      }
    for (; touched != 0; touched &= touched - 1, ++place) {
      const auto slot = static_cast<std::uint32_t>(std::countr_zero(touched));
      std::uint64_t share = 0;
      for (SparseSums::Block* block : blocks) share += block->take(slot);
      row.elements[place] = number * SparseSums::slotsInBlock + slot;
      row.shares[place] = share;
    }
  });
}

/// Removes `slot` from the end of a row if it is there, and returns its share.
std::uint64_t takeLast(FormFactorRow& row, std::uint32_t slot) {
  if (row.elements.empty() || row.elements.back() != slot) return 0;
  const std::uint64_t share = row.shares.back();
  row.elements.pop_back();
  row.shares.pop_back();
  return share;
}

}  // namespace

ItemBufferSum::ItemBufferSum(const Discretization& discretization, const IdLayout& layout)
    : slots_(discretization, layout) {
  sums_.mine(slots_.count());  // so that takeRow always finds one
}

void ItemBufferSum::add(const Projection& projection, const Window& window, const raster::ItemBuffer& buffer) {
  constexpr int pixelsOfThread = 8192;
  const int height = window.scissor.height, rows = std::max(1, pixelsOfThread / std::max(1, window.scissor.width));
  raster::parallelFor(static_cast<std::size_t>((height + rows - 1) / rows), [&](std::size_t part) {
    const int firstRow = static_cast<int>(part) * rows;
    addRows(slots_, projection, window, buffer, firstRow, std::min(firstRow + rows, height),
            sums_.mine(slots_.count()));
  });
}

FormFactorRow ItemBufferSum::rowOf(const Projection& projection, std::span<const Window> windows,
                                   std::span<const raster::ItemBuffer> buffers) {
  assert(windows.size() == buffers.size());
  raster::parallelFor(windows.size(), [&](std::size_t w) { add(projection, windows[w], buffers[w]); });
  return takeRow();
}

FormFactorRow ItemBufferSum::takeRow() {
  std::vector<SparseSums*> all;
  for (auto& [thread, sums] : sums_.all()) all.push_back(&sums);
  const std::size_t groups = all.front()->groups();
  std::vector<std::size_t> first(groups + 1);
  raster::parallelFor(groups, [&](std::size_t group) { first[group + 1] = elementsIn(all, group); });
  std::partial_sum(first.begin(), first.end(), first.begin());
  FormFactorRow row;
  row.elements.resize(first.back());
  row.shares.resize(first.back());
  raster::parallelFor(groups, [&](std::size_t group) {
    moveGroup(all, group, first[group], row);
    for (SparseSums* sums : all) sums->clear(group);
  });
  for (SparseSums* sums : all) sums->reuse();
  row.background = takeLast(row, slots_.background());
  row.back = takeLast(row, slots_.back());
  return row;
}

std::size_t ItemBufferSum::bytes() const {
  std::size_t bytes = slots_.bytes();
  for (const auto& [thread, sums] : sums_.all()) bytes += sums.bytes();
  return bytes;
}

}  // namespace hemitex::radiosity
