#include "raster/culling/triangle_cluster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hemitex::raster {
namespace {

/// Products of rows and positions up to this size stay finite in binary32.
constexpr double largestPosition = 1e15;

bool isPlain(const glm::vec3& position, const glm::vec2& texcoord) {
  return std::abs(position.x) <= largestPosition && std::abs(position.y) <= largestPosition &&
         std::abs(position.z) <= largestPosition && std::isfinite(texcoord.x) && std::isfinite(texcoord.y);
}

void append(const DrawList& list, const TriangleRun& run, Cluster& cluster) {
  const double infinity = std::numeric_limits<double>::infinity();
  cluster.runs.push_back(run);
  for (std::size_t i = 3 * std::size_t{run.first}; i < 3 * std::size_t{run.end}; ++i) {
    const std::uint32_t index = list.indices[i];
    const bool plain = isPlain(list.positions[index], list.texcoords[index]);
    cluster.box.low = glm::min(cluster.box.low, plain ? glm::dvec3(list.positions[index]) : glm::dvec3(-infinity));
    cluster.box.high = glm::max(cluster.box.high, plain ? glm::dvec3(list.positions[index]) : glm::dvec3(infinity));
  }
}

}  // namespace

std::uint32_t triangleCount(const Cluster& cluster) {
  std::uint32_t count = 0;
  for (const TriangleRun& run : cluster.runs) count += run.end - run.first;
  return count;
}

TriangleRun triangleOf(const Cluster& cluster, std::uint32_t t) {
  auto run = cluster.runs.begin();
  for (; t >= run->end - run->first; ++run) t -= run->end - run->first;
  return {run->draw, run->first + t, run->first + t + 1};
}

std::vector<Cluster> clustersOf(const DrawList& list) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Cluster> clusters;
  std::uint32_t room = 0;  // triangles that the last cluster can still take
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw) {
    const std::uint32_t end = (list.draws[draw].first + list.draws[draw].count) / 3;
    std::uint32_t first = list.draws[draw].first / 3;
    while (first < end) {
      const std::uint32_t count = std::min(largestCluster, end - first);
      if (count > room || list.draws[draw].indexMap) {
        clusters.push_back({{}, {glm::dvec3(infinity), glm::dvec3(-infinity)}});
        room = largestCluster;
      }
      append(list, {draw, first, first + count}, clusters.back());
      room = list.draws[draw].indexMap ? 0 : room - count;
      first += count;
    }
  }
  return clusters;
}

Scissor coveredBounds(const DrawList& list, std::span<const Cluster> clusters, const Face& face) {
  const ViewBounds view(face);
  std::vector<ScreenTriangle> triangles;
  for (const Cluster& cluster : clusters)
    if (view.mayShow(cluster.box)) appendScreenTriangles(list, face, cluster.runs, {}, triangles);
  if (triangles.empty()) return {face.scissor.column, face.scissor.row, 0, 0};
  int firstColumn = face.resolution, endColumn = 0, firstRow = face.resolution, endRow = 0;
  for (const ScreenTriangle& triangle : triangles) {
    firstColumn = std::min(firstColumn, triangle.firstColumn);
    endColumn = std::max(endColumn, triangle.endColumn);
    firstRow = std::min(firstRow, triangle.firstRow);
    endRow = std::max(endRow, triangle.endRow);
  }
  return {firstColumn, firstRow, endColumn - firstColumn, endRow - firstRow};
}

}  // namespace hemitex::raster
