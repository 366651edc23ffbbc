#include "raster/kernels/run_kernels.h"

namespace hemitex::raster {
namespace {

void findChanges(const Word* words, std::size_t count, std::uint64_t* changes) {
  for (std::size_t first = 0; first < count; first += changesAtOnce) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < changesAtOnce && first + i < count; ++i, ++words)
      bits |= std::uint64_t{*words != *(words - 1)} << i;
    *changes++ = bits;
  }
}

}  // namespace

const WordKernels& plainWordKernels() {
  static const WordKernels kernels{"plain", findChanges};
  return kernels;
}

const WordKernels& bestWordKernels() {
  return simdWordKernels().empty() ? plainWordKernels() : simdWordKernels().front();
}

}  // namespace hemitex::raster
