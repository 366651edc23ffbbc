/// The vertices of a cluster in the view of a face (docs/item-buffers.md, "view" and "snap"), and which of its
/// triangles may cover samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/culling/cluster_mesh.h"
#include "raster/interface/face.h"

namespace hemitex::raster {

/// The vertices of a cluster in the view of a face. `x` and `y` are the snapped positions of vertices inside all
/// clip half-spaces, else 0.
struct PlacedVertices {
  static constexpr std::size_t capacity = 3 * largestCluster + maxVertexLanes;
  std::array<float, capacity> w;
  std::array<std::int32_t, capacity> x, y;
  std::array<std::int32_t, capacity> sides;  ///< bits, see below
};

/// The near plane or the sides of the view that a finite vertex lies beyond. A triangle is invisible if all its
/// vertices lie beyond the same one.
inline constexpr std::int32_t beyondNear = 1, beyondRight = 2, beyondLeft = 4, beyondBottom = 8, beyondTop = 16;
inline constexpr std::int32_t beyondAny = 31;
/// Outside a clip half-space, or not finite.
inline constexpr std::int32_t notInside = 32;

/// In sub-pixels: 32 pixels, see small_triangles.h.
inline constexpr std::int32_t smallSpan = 32 * 256;

/// Triangles of a cluster, one bit each.
struct TriangleSets {
  std::uint32_t whole = 0;  ///< need no clipping, and a sample of the scissor rectangle lies inside their bounds
  std::uint32_t small = 0;  ///< those of `whole` that are narrower and lower than smallSpan
  std::uint32_t tiny = 0;   ///< those of `small` whose bounds hold at most two columns and two rows of samples
  std::uint32_t cut = 0;    ///< need clipping, or have a value that is not finite
};

}  // namespace hemitex::raster
