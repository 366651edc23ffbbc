#include "raster/software/cluster_setup.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hemitex::raster {
namespace {

/// The skipped triangles of a cluster, one bit each.
std::uint32_t skippedOf(const Cluster& cluster, std::span<const std::uint32_t> skipped) {
  std::uint32_t bits = 0;
  std::uint32_t before = 0;  // number of triangles in the runs before
  for (const TriangleRun& run : cluster.runs) {
    if (!skipped.empty() && skipped.back() >= run.first && skipped.front() < run.end)
      for (auto skip = std::lower_bound(skipped.begin(), skipped.end(), run.first); skip != skipped.end(); ++skip) {
        if (*skip >= run.end) break;
        bits |= 1U << (before + *skip - run.first);
      }
    before += run.end - run.first;
  }
  return bits;
}

}  // namespace

bool makeScreenTriangle(const DrawList& list, const ClusterMesh& mesh, const Cluster& cluster, const ClusterPart& part,
                        std::uint32_t t, const PlacedVertices& placed, const Scissor& scissor, bool mirrored,
                        ScreenTriangle& triangle) {
  std::array<SnappedPoint, 3> snapped;
  std::array<ViewVertex, 3> vertices;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t corner = mesh.corners[k][part.firstTriangle + t];
    const glm::vec2& texcoord = mesh.texcoords[part.firstVertex + corner];
    snapped[k] = {placed.x[corner], placed.y[corner]};
    vertices[k] = {0, 0, placed.w[corner], texcoord.x, texcoord.y};
  }
  if (!makeScreenTriangle(scissor, snapped, vertices, mirrored, triangle)) return false;
  const TriangleRun one = triangleOf(cluster, t);
  triangle.draw = one.draw;
  triangle.number = one.first;
  return !isCulled(list.draws[one.draw], triangle.facesAway);
}

TriangleSets appendScreenTriangles(const DrawList& list, const ClusterMesh& mesh, const Cluster& cluster,
                                   const ClusterPart& part, const Kernels& kernels, const Face& face,
                                   std::span<const std::uint32_t> skipped, PlacedVertices& placed,
                                   std::vector<ScreenTriangle>& triangles) {
  // A value that is not finite made the box infinite. It may be a texture coordinate, which the kernels ignore.
  if (!std::isfinite(cluster.box.low.x)) {
    appendScreenTriangles(list, face, cluster.runs, skipped, triangles);
    return {};
  }
  const TriangleSets sets = kernels.place(mesh, part, face, placed);
  if ((sets.whole | sets.cut) == 0) return {};
  const std::uint32_t drawn = ~skippedOf(cluster, skipped);
  const bool mirrored = determinant(face) < 0;
  for (std::uint32_t left = (sets.whole | sets.cut) & ~sets.small & drawn; left != 0; left &= left - 1) {
    const auto t = static_cast<std::uint32_t>(std::countr_zero(left));
    if ((sets.cut >> t & 1) != 0) {
      const TriangleRun one = triangleOf(cluster, t);
      appendScreenTriangles(list, face, {&one, 1}, {}, triangles);
      continue;
    }
    ScreenTriangle& triangle = triangles.emplace_back();
    if (!makeScreenTriangle(list, mesh, cluster, part, t, placed, face.scissor, mirrored, triangle))
      triangles.pop_back();
  }
  return {.small = sets.small & drawn, .tiny = sets.tiny & drawn};
}

}  // namespace hemitex::raster
