/// Run kernels: find where runs of equal item IDs end. The scalar version is the specification. There is one more
/// version per SIMD instruction set of the processor, with the same results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/interface/item_id.h"
#include "raster/kernels/kernel_lists.h"

namespace hemitex::raster {

/// Number of changes per element of the bit array.
inline constexpr std::size_t changesAtOnce = 64;

struct RunKernels {
  std::string name;  ///< "scalar", or the name of an instruction set

  /// Sets bit i % 64 of changes[i / 64] if ids[i] differs from ids[i - 1], else clears it. ids[-1] must be readable.
  /// Bits from `count` on are cleared.
  void (*findChanges)(const ItemId* ids, std::size_t count, std::uint64_t* changes);
};

template <>
const RunKernels& scalarKernels<RunKernels>();
template <>
const std::vector<RunKernels>& simdKernels<RunKernels>();

}  // namespace hemitex::raster
