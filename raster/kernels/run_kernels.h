/// Item ID kernels: where runs of equal item IDs end. There is a plain version, which says what they compute, and one
/// for each SIMD instruction set that the processor has; all give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::raster {

/// Bits of changes that are kept in one number.
inline constexpr std::size_t changesAtOnce = 64;

struct RunKernels {
  std::string name;  ///< plain, or that of an instruction set

  /// Sets bit i % 64 of changes[i / 64] where item IDs[i] differs from item IDs[i - 1], which is there for i = 0 as
  /// well, and clears it elsewhere; bits from `count` on are clear.
  void (*findChanges)(const ItemId* ids, std::size_t count, std::uint64_t* changes);
};

/// The specification of the others.
const RunKernels& plainRunKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<RunKernels>& simdRunKernels();
/// The first of simdRunKernels(), else the plain ones.
const RunKernels& bestRunKernels();

}  // namespace hemitex::raster
