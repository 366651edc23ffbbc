/// Small triangles: those less than 32 pixels wide and high. A tessellated scene consists almost only of these, and the
/// setup of a screen triangle takes longer than its pixels. Their kernels work directly on the transformed vertices of
/// a cluster.
///
/// The first step sets up planes of coverage, 1/w and texels, with one triangle per SIMD lane. The second step tests
/// the samples of each triangle against the depth buffer and writes item IDs, with one sample per lane.
///
/// Planes are relative to the first sample of the triangle's bounds. There, corners are less than 2^13 sub-pixels away,
/// and edge values are integers below 2^28.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/culling/cluster_mesh.h"
#include "raster/interface/face.h"
#include "raster/interface/item_id.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/placed_vertices.h"

namespace hemitex::raster {

/// Triangles of a part of a mesh with transformed vertices.
struct SmallTriangles {
  const ClusterMesh& mesh;
  const ClusterPart& part;
  const PlacedVertices& placed;
  std::uint32_t set, tiny;    ///< one bit per triangle: subsets of TriangleSets::small and tiny
  int columns = 1, rows = 1;  ///< of the index map of the triangles
};

/// One value per triangle. Kernels write maxVertexLanes values at a time.
template <typename Value>
using EachSmall = std::array<Value, largestCluster>;

/// The most rows of samples that a small triangle covers.
inline constexpr std::size_t smallRows = smallSpan / 256;

/// Values that are linear in the column i and the row j, from the first sample in the bounds of a triangle:
/// (at + down * j) + right * i.
struct SmallPlanes {
  EachSmall<double> at, right, down;
};

/// Small triangles after setup, without most of those that cover no sample. Sets have one bit per entry.
struct SmallSetup {
  std::uint32_t count = 0;
  /// Counted from the first of the part. Kernels may write maxVertexLanes values behind the last.
  std::array<std::int32_t, largestCluster + maxVertexLanes> triangles;
  EachSmall<std::int32_t> firstColumn, columns, firstRow, rows;  ///< the samples in the bounds; no rows: not drawn
  std::array<SmallPlanes, 3> edges;                              ///< at least 0 at covered samples
  SmallPlanes inverseDepth;                                      ///< 1/w, with a relative error below depthError
  SmallPlanes column, row;                                       ///< of the texel, over w
  /// Positions in a texel whose distance from the middle is below this are resolved: 1/2 less the error bound.
  EachSmall<double> clear;
  EachSmall<std::int32_t> texel;  ///< row * columns + column, if all samples have the same texel
  std::uint32_t uniform = 0;      ///< triangles with one texel for all samples
  std::uint32_t negative = 0;     ///< triangles with a negative area (docs/item-buffers.md, "facing")
  std::uint32_t thin = 0;         ///< long slivers, for which the planes are not accurate enough; not drawn
};

/// A sample of an entry of a setup.
struct SmallSample {
  std::uint32_t entry;
  Pixel pixel;
};

/// Samples that are not resolved in double precision.
struct UnresolvedSamples {
  std::vector<SmallSample> samples;

  void add(const SmallSample& sample);  // not inline, see UnresolvedPixels
};

/// How the entries of a setup get their item IDs. That of a textured triangle is its own plus the texel, or plus the
/// value of the texel in `map`.
struct SmallIds {
  EachSmall<ItemId> ids;
  std::uint32_t textured = 0;  ///< one bit per entry
  double columns = 1, rows = 1;
  const ItemId* map = nullptr;  ///< none if the texels equal their numbers
};

}  // namespace hemitex::raster
