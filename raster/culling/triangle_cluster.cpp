#include "raster/culling/triangle_cluster.h"

#include <algorithm>
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

constexpr double infinity = std::numeric_limits<double>::infinity();

Box boxOf(const DrawList& list, const TriangleRun& run) {
  Box box{glm::dvec3(infinity), glm::dvec3(-infinity)};
  for (std::size_t i = 3 * std::size_t{run.first}; i < 3 * std::size_t{run.end}; ++i) {
    const std::uint32_t index = list.indices[i];
    const bool plain = isPlain(list.positions[index], list.texcoords[index]);
    box.low = glm::min(box.low, plain ? glm::dvec3(list.positions[index]) : glm::dvec3(-infinity));
    box.high = glm::max(box.high, plain ? glm::dvec3(list.positions[index]) : glm::dvec3(infinity));
  }
  return box;
}

double diagonalOf(const Box& box) { return glm::length(box.high - box.low); }

/// A cluster while runs are added.
struct OpenCluster {
  std::uint32_t room = 0;  ///< number of triangles that it can still take
  double diagonals = 0;    ///< the sum of those of the boxes of its runs
};

/// Whether a cluster has at most one index map with a further draw.
bool haveOneMap(const Cluster& cluster, const Draw& draw) {
  return !cluster.indexMap || !draw.indexMap || *cluster.indexMap == *draw.indexMap;
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
  std::vector<Cluster> clusters;
  OpenCluster open;
  for (std::uint32_t number = 0; number < list.draws.size(); ++number) {
    const Draw& draw = list.draws[number];
    const std::uint32_t end = (draw.first + draw.count) / 3;
    for (std::uint32_t first = draw.first / 3; first < end;) {
      const std::uint32_t count = std::min(largestCluster, end - first);
      const TriangleRun run{number, first, first + count};
      const Box box = boxOf(list, run);
      open.diagonals += diagonalOf(box);
      if (count > open.room || !haveOneMap(clusters.back(), draw) ||
          diagonalOf(around(clusters.back().box, box)) > open.diagonals) {
        clusters.push_back({{}, box, {}});
        open = {largestCluster, diagonalOf(box)};
      }
      Cluster& cluster = clusters.back();
      cluster.runs.push_back(run);
      cluster.box = around(cluster.box, box);
      if (draw.indexMap) cluster.indexMap = draw.indexMap;
      open.room -= count;
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
