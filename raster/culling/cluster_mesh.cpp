#include "raster/culling/cluster_mesh.h"

#include <algorithm>

namespace hemitex::raster {
namespace {

/// Draw lists may have one vertex per corner; vertices that are equal in all values are merged.
bool areAlike(const DrawList& list, std::uint32_t a, std::uint32_t b) {
  return a == b || (list.positions[a] == list.positions[b] && list.texcoords[a] == list.texcoords[b]);
}

void append(const DrawList& list, const Cluster& cluster, ClusterMesh& mesh) {
  const auto firstVertex = static_cast<std::uint32_t>(mesh.positions[0].size());
  const auto firstTriangle = static_cast<std::uint32_t>(mesh.corners[0].size());
  std::vector<std::uint32_t> vertices;  // indices of the draw list
  for (const TriangleRun& run : cluster.runs) {
    mesh.draws.insert(mesh.draws.end(), run.end - run.first, run.draw);
    for (std::size_t i = 3 * std::size_t{run.first}; i < 3 * std::size_t{run.end}; ++i) {
      const std::uint32_t index = list.indices[i];
      const auto place = std::find_if(vertices.begin(), vertices.end(),
                                      [&](std::uint32_t vertex) { return areAlike(list, vertex, index); });
      mesh.corners[i % 3].push_back(static_cast<std::uint8_t>(place - vertices.begin()));
      if (place == vertices.end()) vertices.push_back(index);
    }
  }
  for (const std::uint32_t index : vertices) {
    mesh.texcoords.push_back(list.texcoords[index]);
    for (int axis = 0; axis < 3; ++axis)
      mesh.positions[static_cast<std::size_t>(axis)].push_back(list.positions[index][axis]);
  }
  mesh.parts.push_back(
      {firstVertex, static_cast<std::uint32_t>(vertices.size()), firstTriangle, triangleCount(cluster)});
}

}  // namespace

ClusterMesh meshOf(const DrawList& list, std::span<const Cluster> clusters) {
  ClusterMesh mesh;
  for (const Cluster& cluster : clusters) append(list, cluster, mesh);
  for (auto& values : mesh.positions) values.resize(values.size() + maxVertexLanes);
  for (auto& values : mesh.corners) values.resize(values.size() + maxVertexLanes);
  return mesh;
}

}  // namespace hemitex::raster
