/// The screen triangles of a cluster, through the vertex kernels: only what is not left out there is set up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/cluster.h"
#include "raster/cluster_mesh.h"
#include "raster/screen_triangle.h"
#include "raster/vertex_kernels.h"

namespace hemitex::raster {

/// Appends the screen triangles of a cluster, `part` of the mesh, in draw order. Triangles in `skipped` (ascending) are
/// left out; returns how many were dropped because a value was not finite.
std::uint64_t appendScreenTriangles(const DrawList& list, const ClusterMesh& mesh, const Cluster& cluster,
                                    const ClusterPart& part, const VertexKernels& kernels, const Face& face,
                                    std::span<const std::uint32_t> skipped, std::vector<ScreenTriangle>& triangles);

}  // namespace hemitex::raster
