#include "radiosity/form_factors/item_buffer_sum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "raster/base/parallel.h"
#include "raster/kernels/kernels.h"

namespace hemitex::radiosity {
namespace {

using raster::ItemId;

/// Pixels whose runs are added at once. All but the first are compared with the pixel before, in complete groups.
constexpr std::size_t pixelsAtOnce = 16 * raster::changesAtOnce + 1;
static_assert(pixelsAtOnce <= SparseSums::maxAtOnce);

/// The runs of up to pixelsAtOnce adjacent pixels.
struct Runs {
  std::size_t count = 0;
  std::array<ItemId, pixelsAtOnce> ids;
  std::array<std::uint64_t, pixelsAtOnce + 1> before;  ///< running sum of shares before each run, and after the last
};

/// `before` holds the running sum of shares before each pixel, and after the last.
void findRuns(const ItemId* ids, const std::uint64_t* before, std::size_t count, Runs& runs) {
  std::array<std::uint64_t, pixelsAtOnce / raster::changesAtOnce> changes;
  raster::bestKernels().findChanges(ids + 1, count - 1, changes.data());
  runs.count = 0;
  runs.before[0] = before[0];
  const auto endRun = [&](std::size_t end) {
    runs.ids[runs.count] = ids[end - 1];
    runs.before[++runs.count] = before[end];
  };
  for (std::size_t first = 1; first < count; first += raster::changesAtOnce)
    for (std::uint64_t ends = changes[first / raster::changesAtOnce]; ends != 0; ends &= ends - 1)
      endRun(first + static_cast<std::size_t>(std::countr_zero(ends)));
  endRun(count);
}

/// Adds up to pixelsAtOnce adjacent pixels.
void addPixels(const IdLookup& lookup, const ItemId* ids, const std::uint64_t* before, std::size_t count,
               SparseSums& sums) {
  Runs runs;
  std::array<std::uint32_t, pixelsAtOnce> slots;
  findRuns(ids, before, count, runs);
  lookup.find({runs.ids.data(), runs.count}, slots.data());
  sums.add({slots.data(), runs.count}, runs.before.data());
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
    const ItemId* ids = buffer.ids.data() + static_cast<std::ptrdiff_t>(row) * some.width;
    const std::uint64_t* sharesBefore = before + first + (some.column - whole.column);
    for (std::size_t pixel = 0; pixel < count; pixel += pixelsAtOnce)
      addPixels(slots, ids + pixel, sharesBefore + pixel, std::min(pixelsAtOnce, count - pixel), sums);
  };
  const auto width = static_cast<std::size_t>(some.width);
  // If the window has the full width, rows are contiguous, and a run may continue in the next row.
  if (some.width == whole.width) return add(firstRow, width * static_cast<std::size_t>(endRow - firstRow));
  for (int row = firstRow; row < endRow; ++row) add(row, width);
}

using AllSums = std::span<const std::unique_ptr<SparseSums>>;

/// Calls body(number) for the blocks of a group that any of the sums has, in ascending order.
template <typename Body>
void forEachBlock(AllSums all, std::size_t group, const Body& body) {
  std::uint64_t blocks = 0;
  for (const auto& sums : all) blocks |= sums->blocksIn(group);
  for (; blocks != 0; blocks &= blocks - 1)
    body(static_cast<std::uint32_t>(group * SparseSums::blocksInGroup) +
         static_cast<std::uint32_t>(std::countr_zero(blocks)));
}

/// Adds the shares of `from` to `to`, and resets them.
void moveShares(const SparseSums::Block& from, SparseSums::Block& to) {
  to.touched |= from.touched;
  for (std::uint64_t touched = from.touched; touched != 0; touched &= touched - 1) {
    const int slot = std::countr_zero(touched);
    to.shares[slot] += std::exchange(from.shares[slot], 0);
  }
}

std::size_t elementsIn(AllSums all, std::size_t group) {
  std::size_t elements = 0;
  forEachBlock(all, group, [&](std::uint32_t number) {
    std::uint64_t touched = 0;
    for (const auto& sums : all)
      if (const auto block = sums->find(number)) touched |= block->touched;
    elements += static_cast<std::size_t>(std::popcount(touched));
  });
  return elements;
}

/// Moves the shares of a group into a row, from `place` on.
void moveGroup(AllSums all, std::size_t group, std::size_t place, FormFactorRow& row) {
  forEachBlock(all, group, [&](std::uint32_t number) {
    std::optional<SparseSums::Block> total;
    for (const auto& sums : all)
      if (const auto block = sums->find(number)) {
        if (total)
          moveShares(*block, *total);
        else
          total = block;
      }
    for (std::uint64_t touched = total->touched; touched != 0; touched &= touched - 1, ++place) {
      const auto slot = static_cast<std::uint32_t>(std::countr_zero(touched));
      row.elements[place] = number * SparseSums::slotsInBlock + slot;
      row.shares[place] = std::exchange(total->shares[slot], 0);
    }
  });
}

/// Moves all shares into a row; slots take the place of elements.
FormFactorRow movedRow(AllSums all) {
  if (all.empty()) return {};
  const std::size_t groups = all.front()->groups();
  std::vector<std::size_t> first(groups + 1);
  raster::parallelFor(groups, [&](std::size_t group) { first[group + 1] = elementsIn(all, group); });
  std::partial_sum(first.begin(), first.end(), first.begin());
  FormFactorRow row;
  row.elements.resize(first.back());
  row.shares.resize(first.back());
  raster::parallelFor(groups, [&](std::size_t group) {
    moveGroup(all, group, first[group], row);
    for (const auto& sums : all) sums->clear(group);
  });
  for (const auto& sums : all) sums->reuse();
  return row;
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
    : slots_(discretization, layout), sums_([this] { return SparseSums(slots_.count()); }) {}

void ItemBufferSum::add(const Projection& projection, const Window& window, const raster::ItemBuffer& buffer) {
  constexpr int pixelsOfThread = 8192;
  const int height = window.scissor.height, rows = std::max(1, pixelsOfThread / std::max(1, window.scissor.width));
  raster::parallelFor(static_cast<std::size_t>((height + rows - 1) / rows), [&](std::size_t part) {
    const int firstRow = static_cast<int>(part) * rows;
    sums_.with([&](SparseSums& sums) {
      addRows(slots_, projection, window, buffer, firstRow, std::min(firstRow + rows, height), sums);
    });
  });
}

FormFactorRow ItemBufferSum::rowOf(const Projection& projection,
                                   const std::function<void(const AddWindow& add)>& draw) {
  draw([&](const Window& window, const raster::ItemBuffer& buffer) { add(projection, window, buffer); });
  FormFactorRow row = movedRow(sums_.values());
  return rowOf({std::move(row.elements), std::move(row.shares)});
}

FormFactorRow ItemBufferSum::rowOf(raster::SlotSums sums) const {
  FormFactorRow row{std::move(sums.slots), std::move(sums.sums)};
  row.background = takeLast(row, slots_.background());
  row.back = takeLast(row, slots_.back());
  return row;
}

FormFactorRow ItemBufferSum::rowOf(const Projection& projection, std::span<const Window> windows,
                                   std::span<const raster::ItemBuffer> buffers) {
  assert(windows.size() == buffers.size());
  return rowOf(projection, [&](const AddWindow& add) {
    raster::parallelFor(windows.size(), [&](std::size_t w) { add(windows[w], buffers[w]); });
  });
}

std::size_t ItemBufferSum::bytes() const {
  std::size_t bytes = slots_.bytes();
  for (const auto& sums : sums_.values()) bytes += sums->bytes();
  return bytes;
}

}  // namespace hemitex::radiosity
