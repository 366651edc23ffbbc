/// Triangle setup of a cluster with the vertex kernels. Only triangles that pass their culling become screen triangles.
/// Small triangles do not; they have their own kernels (small_triangles.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/culling/cluster_mesh.h"
#include "raster/culling/triangle_cluster.h"
#include "raster/kernels/kernels.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

/// Transforms the vertices of a cluster, `part` of the mesh, and appends the screen triangles of those that are not
/// small, in draw order. Leaves out the triangles in `skipped` (ascending). Returns the small and the tiny ones.
TriangleSets appendScreenTriangles(const DrawList& list, const ClusterMesh& mesh, const Cluster& cluster,
                                   const ClusterPart& part, const Kernels& kernels, const Face& face,
                                   std::span<const std::uint32_t> skipped, PlacedVertices& placed,
                                   std::vector<ScreenTriangle>& triangles);

/// Sets up the `t`th triangle of a cluster, which needs no clipping. Returns false if it covers no sample or is culled.
bool makeScreenTriangle(const DrawList& list, const ClusterMesh& mesh, const Cluster& cluster, const ClusterPart& part,
                        std::uint32_t t, const PlacedVertices& placed, const Scissor& scissor, bool mirrored,
                        ScreenTriangle& triangle);

}  // namespace hemitex::raster
