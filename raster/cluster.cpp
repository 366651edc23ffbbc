#include "raster/cluster.h"

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

/// Adds a run to a cluster.
void append(const DrawList& list, const TriangleRun& run, Cluster& cluster) {
  const double infinity = std::numeric_limits<double>::infinity();
  cluster.runs.push_back(run);
  for (std::size_t i = 3 * std::size_t{run.first}; i < 3 * std::size_t{run.end}; ++i) {
    const std::uint32_t index = list.indices[i];
    const bool plain = isPlain(list.positions[index], list.texcoords[index]);
    cluster.low = glm::min(cluster.low, plain ? glm::dvec3(list.positions[index]) : glm::dvec3(-infinity));
    cluster.high = glm::max(cluster.high, plain ? glm::dvec3(list.positions[index]) : glm::dvec3(infinity));
  }
}

/// A box as seen from an eye.
struct Box {
  glm::dvec3 centre, half;
  double reach;  ///< no corner is farther from the eye
};

/// Whether plane . d > offset for all points of a box, by more than the vertex stage can round: its five roundings of
/// binary32 change a product of `size` and a distance by less than 2^-21 of it. With NaN, false.
bool isBeyond(const Box& box, const glm::dvec3& plane, double size, double offset) {
  const double least = glm::dot(plane, box.centre) - glm::dot(glm::abs(plane), box.half);
  return least - offset > 0x1p-19 * size * box.reach;
}

}  // namespace

std::uint32_t triangleCount(const Cluster& cluster) {
  std::uint32_t count = 0;
  for (const TriangleRun& run : cluster.runs) count += run.end - run.first;
  return count;
}

std::vector<Cluster> clustersOf(const DrawList& list) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Cluster> clusters;
  std::uint32_t room = 0;  // in the last cluster
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw) {
    const std::uint32_t end = (list.draws[draw].first + list.draws[draw].count) / 3;
    std::uint32_t first = list.draws[draw].first / 3;
    while (first < end) {
      const std::uint32_t count = std::min(largestCluster, end - first);
      if (count > room || list.draws[draw].indexMap) {
        clusters.push_back({{}, glm::dvec3(infinity), glm::dvec3(-infinity)});
        room = largestCluster;
      }
      append(list, {draw, first, first + count}, clusters.back());
      room = list.draws[draw].indexMap ? 0 : room - count;
      first += count;
    }
  }
  return clusters;
}

bool mayCover(const Face& face, const Cluster& cluster) {
  const glm::dvec3 x(face.x), y(face.y), w(face.w);
  Box box{0.5 * (cluster.low + cluster.high) - glm::dvec3(face.eye), 0.5 * (cluster.high - cluster.low), 0};
  box.reach = glm::length(box.centre) + glm::length(box.half);
  const double width = glm::length(w);
  if (isBeyond(box, -w, width, -static_cast<double>(face.nearDistance))) return false;
  // The sides of the scissor rectangle on the picture plane, one pixel out, which is more than snapping moves a vertex.
  const double pixel = 2.0 / face.resolution;
  const auto isBesides = [&](const glm::dvec3& axis, int first, int count) {
    const double low = (first - 1) * pixel - 1, high = (first + count + 1) * pixel - 1;
    const double size = glm::length(axis);
    return isBeyond(box, low * w - axis, std::abs(low) * width + size, 0) ||
           isBeyond(box, axis - high * w, std::abs(high) * width + size, 0);
  };
  return !isBesides(x, face.scissor.column, face.scissor.width) && !isBesides(y, face.scissor.row, face.scissor.height);
}

Scissor coveredBounds(const DrawList& list, std::span<const Cluster> clusters, const Face& face) {
  std::vector<ScreenTriangle> triangles;
  for (const Cluster& cluster : clusters)
    if (mayCover(face, cluster)) appendScreenTriangles(list, face, cluster.runs, {}, triangles);
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
