#include "raster/kernels/run_kernels.h"

namespace hemitex::raster {
namespace {

void findChanges(const ItemId* ids, std::size_t count, std::uint64_t* changes) {
  for (std::size_t first = 0; first < count; first += changesAtOnce) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < changesAtOnce && first + i < count; ++i, ++ids)
      bits |= std::uint64_t{*ids != *(ids - 1)} << i;
    *changes++ = bits;
  }
}

}  // namespace

template <>
const RunKernels& scalarKernels<RunKernels>() {
  static const RunKernels kernels{"scalar", findChanges};
  return kernels;
}

}  // namespace hemitex::raster
