/// Kernels for small triangles: those less than eight pixels wide and high. A finely tessellated scene consists almost
/// only of these, and the setup of a screen triangle takes longer than its pixels. These kernels work directly on the
/// transformed vertices of a cluster.
///
/// The first step finds covered samples, with one triangle per SIMD lane. The second step computes 1/w and texels, with
/// one sample per lane. The scalar version is the specification. There is one more version per SIMD instruction set of
/// the processor, with the same results, bit for bit.
///
/// Positions are relative to a nearby sample: corners are less than 2^11 sub-pixels away, and edge values are integers
/// below 2^23. 1/w and texels are computed in double precision. If its error bound (interpolation_bounds.h) does not
/// resolve a texel, the caller computes it exactly.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/culling/cluster_mesh.h"
#include "raster/interface/face.h"
#include "raster/kernels/kernel_lists.h"
#include "raster/kernels/vertex_kernels.h"

namespace hemitex::raster {

/// Triangles of a part of a mesh with transformed vertices.
struct SmallTriangles {
  const ClusterMesh& mesh;
  const ClusterPart& part;
  const PlacedVertices& placed;
  std::uint32_t set;          ///< one bit per triangle: a subset of TriangleSets::small
  int columns = 1, rows = 1;  ///< of the index map of the triangles
};

/// Marks a texel that is not resolved in double precision.
inline constexpr std::int32_t undecidedTexel = -1;

/// The samples that small triangles of one part cover.
struct SmallSamples {
  /// A side of less than eight pixels holds at most eight samples. Kernels may write maxVertexLanes samples more.
  static constexpr std::size_t most = 8 * 8 * largestCluster + maxVertexLanes;
  template <typename Value>
  using Each = std::array<Value, most>;

  std::size_t count = 0;
  Each<std::int32_t> triangles;  ///< the triangle of each sample, counted from the first of the part
  Each<std::int32_t> columns, rows;
  Each<double> inverseDepths;  ///< 1/w, with a relative error below depthError
  Each<std::int32_t> texels;   ///< row * columns + column, or undecidedTexel
  std::uint32_t negative = 0;  ///< one bit per triangle: its area is negative (docs/item-buffers.md, "facing")
};

struct SmallTriangleKernels {
  std::string name;  ///< "scalar", or the name of an instruction set

  /// Finds the samples of the triangles in a part of a face, in any order.
  void (*findSamples)(const SmallTriangles& triangles, const Scissor& part, SmallSamples& samples);
};

template <>
const SmallTriangleKernels& scalarKernels<SmallTriangleKernels>();
template <>
const std::vector<SmallTriangleKernels>& simdKernels<SmallTriangleKernels>();

}  // namespace hemitex::raster
