// The word kernels on vectors, written once for Highway, which compiles this file anew for each instruction set.
#include "raster/kernels/run_kernels.h"
#include "raster/kernels/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/kernels/run_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint32_t, 16>;

constexpr Words wordLanes;

/// Which words of a vector differ from those before them, from bit 0 on.
std::uint64_t changesOfVector(const Word* words) {
  const auto differ = hn::Ne(hn::LoadU(wordLanes, words), hn::LoadU(wordLanes, words - 1));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(wordLanes, differ, bits);
  return bits[0] + 256U * bits[1];
}

void findChanges(const Word* words, std::size_t count, std::uint64_t* changes) {
  const std::size_t lanes = hn::Lanes(wordLanes);
  std::size_t first = 0;
  for (; first + changesAtOnce <= count; first += changesAtOnce) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < changesAtOnce; i += lanes) bits |= changesOfVector(words + first + i) << i;
    *changes++ = bits;
  }
  plainWordKernels().findChanges(words + first, count - first, changes);
}

WordKernels wordKernels() { return {hwy::TargetName(HWY_TARGET), findChanges}; }

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hemitex::raster {
namespace {

HWY_EXPORT(wordKernels);

}  // namespace

const std::vector<WordKernels>& simdWordKernels() {
  static const std::vector<WordKernels> all =
      ofEveryInstructionSet<WordKernels>([] { return HWY_DYNAMIC_DISPATCH(wordKernels)(); });
  return all;
}

}  // namespace hemitex::raster
#endif
