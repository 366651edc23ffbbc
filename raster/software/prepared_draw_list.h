/// A draw list with everything that all faces share: clusters, their hierarchy and their mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/culling/cluster_bvh.h"
#include "raster/culling/cluster_mesh.h"
#include "raster/culling/triangle_cluster.h"
#include "raster/interface/draw_list.h"

namespace hemitex::raster {

struct PreparedDrawList {
  DrawList list;
  std::vector<Cluster> clusters;
  ClusterBvh tree;   ///< over the clusters
  ClusterMesh mesh;  ///< of the triangles of the clusters
  /// Properties of an index map that resolving uses.
  struct MapTraits {
    bool countsTexels;  ///< holds 0, 1, 2, ..., so that texel numbers need no lookup
    ItemId bits;        ///< all bits that its item IDs set
    bool hasHoles;
  };
  std::vector<MapTraits> maps;  ///< one per index map
};

/// Throws InputError if the list breaks the rules (see validate).
PreparedDrawList prepare(DrawList list);

/// Prefetches what drawing a cluster reads; loading it takes about as long as drawing another cluster.
void prefetch(const PreparedDrawList& draws, std::uint32_t cluster);

}  // namespace hemitex::raster
