/// The versions of each kind of kernels (VertexKernels, DepthKernels, ...): scalar code is the specification, and one
/// version per SIMD instruction set gives the same results.
#pragma once

#include <vector>

namespace hemitex::raster {

template <typename Kernels>
const Kernels& scalarKernels();

/// The kernels for all instruction sets of this processor, fastest first; empty in a build without SIMD.
template <typename Kernels>
const std::vector<Kernels>& simdKernels();

template <typename Kernels>
const Kernels& bestKernels() {
  return simdKernels<Kernels>().empty() ? scalarKernels<Kernels>() : simdKernels<Kernels>().front();
}

}  // namespace hemitex::raster
