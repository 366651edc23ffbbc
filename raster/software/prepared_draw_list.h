/// A draw list made ready to be drawn into any face.
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
  ClusterMesh mesh;  ///< of their triangles
  /// What resolving needs to know of an index map.
  struct MapTraits {
    bool countsTexels;  ///< holds 0, 1, 2, ...: which item ID it holds needs no look
    ItemId bits;        ///< all bits that its item IDs set
  };
  std::vector<MapTraits> maps;  ///< one an index map
};

/// Throws InputError where the list breaks the rules (see validate).
PreparedDrawList prepare(DrawList list);

/// Asks memory for all that drawing a cluster reads: on the way, it takes as long as another cluster's drawing.
void prefetch(const PreparedDrawList& draws, std::uint32_t cluster);

}  // namespace hemitex::raster
