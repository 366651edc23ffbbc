/// Word kernels: where runs of equal words end. There is a plain version, which says what they compute, and one for
/// each SIMD instruction set that the processor has; all give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::raster {

/// Bits of changes that are kept in one number.
inline constexpr std::size_t changesAtOnce = 64;

struct WordKernels {
  std::string name;  ///< plain, or that of an instruction set

  /// Sets bit i % 64 of changes[i / 64] where words[i] differs from words[i - 1], which is there for i = 0 as well, and
  /// clears it elsewhere; bits from `count` on are clear.
  void (*findChanges)(const Word* words, std::size_t count, std::uint64_t* changes);
};

/// The specification of the others.
const WordKernels& plainWordKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<WordKernels>& simdWordKernels();
/// The first of simdWordKernels(), else the plain ones.
const WordKernels& bestWordKernels();

}  // namespace hemitex::raster
