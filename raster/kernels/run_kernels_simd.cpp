// SIMD run kernels, written with Highway, which compiles this file once per instruction set.
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

using ItemIds = hn::CappedTag<std::uint32_t, 16>;

constexpr ItemIds idLanes;

/// One bit per item ID of a vector, from bit 0 on: set if it differs from the item ID before it.
std::uint64_t changesOfVector(const ItemId* ids) {
  const auto differ = hn::Ne(hn::LoadU(idLanes, ids), hn::LoadU(idLanes, ids - 1));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(idLanes, differ, bits);
  return bits[0] + 256U * bits[1];
}

void findChanges(const ItemId* ids, std::size_t count, std::uint64_t* changes) {
  const std::size_t lanes = hn::Lanes(idLanes);
  std::size_t first = 0;
  for (; first + changesAtOnce <= count; first += changesAtOnce) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < changesAtOnce; i += lanes) bits |= changesOfVector(ids + first + i) << i;
    *changes++ = bits;
  }
  scalarKernels<RunKernels>().findChanges(ids + first, count - first, changes);
}

RunKernels runKernels() { return {hwy::TargetName(HWY_TARGET), findChanges}; }

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hemitex::raster {
namespace {

HWY_EXPORT(runKernels);

}  // namespace

template <>
const std::vector<RunKernels>& simdKernels<RunKernels>() {
  static const std::vector<RunKernels> all =
      ofEveryInstructionSet<RunKernels>([] { return HWY_DYNAMIC_DISPATCH(runKernels)(); });
  return all;
}

}  // namespace hemitex::raster
#endif
