/// Vertex kernels: the vertex stage and snapping of a cluster's vertices (raster rules, 2 and 4), and a first look at
/// its triangles that leaves out most of those that cover no sample. There is a plain version, which says what they
/// compute, and one for each SIMD instruction set that the processor has; all give the same numbers, bit for bit.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/culling/cluster_mesh.h"
#include "raster/interface/face.h"

namespace hemitex::raster {

/// The vertices of a cluster as a face sees them. Where a vertex lies inside of all that triangles are clipped to,
/// `across` and `down` are its snapped x and y, elsewhere 0.
struct PlacedVertices {
  static constexpr std::size_t most = 3 * largestCluster + maxVertexLanes;
  std::array<float, most> w;
  std::array<std::int32_t, most> across, down;
  std::array<std::int32_t, most> sides;  ///< bits, see below
};

/// What a finite vertex lies beyond: the near plane or a side of the view. A triangle all of whose vertices lie beyond
/// the same shows nothing.
inline constexpr std::int32_t beyondNear = 1, beyondRight = 2, beyondLeft = 4, beyondBottom = 8, beyondTop = 16;
inline constexpr std::int32_t beyondAny = 31;
/// Outside of something that triangles are clipped to, or not finite.
inline constexpr std::int32_t notInside = 32;

/// In sub-pixels: eight pixels, see small_triangle_kernels.h.
inline constexpr std::int32_t smallSpan = 8 * 256;

/// Triangles of a cluster, a bit each.
struct TriangleSets {
  std::uint32_t whole = 0;  ///< need no clipping, and a sample of the scissor rectangle lies inside their bounds
  std::uint32_t small = 0;  ///< of these, what spans less than smallSpan either way
  std::uint32_t cut = 0;    ///< need clipping, or a value of theirs is not finite
};

struct VertexKernels {
  std::string name;  ///< plain, or that of an instruction set

  /// Places the vertices of a part of a mesh and looks at its triangles. Those in neither set cover no sample.
  TriangleSets (*place)(const ClusterMesh& mesh, const ClusterPart& part, const Face& face, PlacedVertices& placed);
};

/// The specification of the others.
const VertexKernels& plainVertexKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<VertexKernels>& simdVertexKernels();
/// The first of simdVertexKernels(), else the plain ones.
const VertexKernels& bestVertexKernels();

}  // namespace hemitex::raster
