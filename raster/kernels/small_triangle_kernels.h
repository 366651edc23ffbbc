/// Small triangles: those that span less than eight pixels either way. Where a scene is cut finely there is next to
/// nothing else, and setting each of them up as a screen triangle takes longer than its pixels do. So there are kernels
/// that find what those of a cluster show, straight from its placed vertices: first the samples that they cover, as
/// many triangles at a time as a vector has lanes; then 1/w and texels, as many samples at a time. There is a plain
/// version, which says what they compute, and one for each SIMD instruction set that the processor has; all give the
/// same numbers, bit for bit.
///
/// Positions count from a sample near by: corners are less than 2^11 sub-pixels away from it, and the values of edges
/// integers below 2^23. 1/w and texels come from binary64; where its error bound (interpolation_bounds.h) does not tell
/// the texel, the caller finds it exactly.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/culling/cluster_mesh.h"
#include "raster/interface/face.h"
#include "raster/kernels/vertex_kernels.h"

namespace hemitex::raster {

/// Triangles of a part of a mesh whose vertices were placed.
struct SmallTriangles {
  const ClusterMesh& mesh;
  const ClusterPart& part;
  const PlacedVertices& placed;
  std::uint32_t set;          ///< a bit each: some of TriangleSets::small
  int columns = 1, rows = 1;  ///< of their index map
};

/// In place of a texel that binary64 does not tell.
inline constexpr std::int32_t undecidedTexel = -1;

/// The samples that small triangles of one part cover, one after the other.
struct SmallSamples {
  /// Less than eight pixels hold eight samples at most; kernels may touch as many more as they have lanes.
  static constexpr std::size_t most = 8 * 8 * largestCluster + maxVertexLanes;
  template <typename Value>
  using Each = std::array<Value, most>;

  std::size_t count = 0;
  Each<std::int32_t> triangles;  ///< that cover them, counted from the part's first
  Each<std::int32_t> columns, rows;
  Each<double> inverseDepths;  ///< 1/w, off by less than depthError
  Each<std::int32_t> texels;   ///< row * columns + column, or undecidedTexel
  std::uint32_t negative = 0;  ///< a bit for each triangle whose area is so (raster rules, 5)
};

struct SmallTriangleKernels {
  std::string name;  ///< plain, or that of an instruction set

  /// Finds the samples of a part of a face, in any order.
  void (*findSamples)(const SmallTriangles& triangles, const Scissor& part, SmallSamples& samples);
};

/// The specification of the others.
const SmallTriangleKernels& plainSmallTriangleKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<SmallTriangleKernels>& simdSmallTriangleKernels();
/// The first of simdSmallTriangleKernels(), else the plain ones.
const SmallTriangleKernels& bestSmallTriangleKernels();

}  // namespace hemitex::raster
