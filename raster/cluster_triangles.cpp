#include "raster/cluster_triangles.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hemitex::raster {
namespace {

/// Sets up the `t`th triangle of a part whose vertices were placed.
void appendPlaced(const ClusterMesh& mesh, const ClusterPart& part, std::uint32_t t, const PlacedVertices& placed,
                  const Scissor& scissor, bool mirrored, std::uint32_t draw, std::vector<ScreenTriangle>& triangles) {
  std::array<SnappedPoint, 3> snapped;
  std::array<ViewVertex, 3> vertices;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t corner = mesh.corners[k][part.firstTriangle + t];
    const glm::vec2& texcoord = mesh.texcoords[part.firstVertex + corner];
    snapped[k] = {placed.across[corner], placed.down[corner]};
    vertices[k] = {0, 0, placed.w[corner], texcoord.x, texcoord.y};
  }
  ScreenTriangle& triangle = triangles.emplace_back();
  triangle.draw = draw;
  if (!makeScreenTriangle(scissor, snapped, vertices, mirrored, triangle)) triangles.pop_back();
}

/// The triangles of a run that are skipped, a bit each.
std::uint32_t skippedOf(const TriangleRun& run, std::span<const std::uint32_t> skipped) {
  std::uint32_t bits = 0;
  if (skipped.empty() || skipped.back() < run.first || skipped.front() >= run.end) return bits;
  for (auto skip = std::lower_bound(skipped.begin(), skipped.end(), run.first); skip != skipped.end(); ++skip) {
    if (*skip >= run.end) break;
    bits |= 1U << (*skip - run.first);
  }
  return bits;
}

}  // namespace

std::uint64_t appendScreenTriangles(const DrawList& list, const ClusterMesh& mesh, const Cluster& cluster,
                                    const ClusterPart& part, const VertexKernels& kernels, const Face& face,
                                    std::span<const std::uint32_t> skipped, std::vector<ScreenTriangle>& triangles) {
  // A value that is not finite made the box so; it may be a texture coordinate, which the kernels do not look at.
  if (!std::isfinite(cluster.box.low.x)) return appendScreenTriangles(list, face, cluster.runs, skipped, triangles);
  PlacedVertices placed;
  const TriangleSets sets = kernels.place(mesh, part, face, placed);
  if ((sets.whole | sets.cut) == 0) return 0;
  const bool mirrored = determinant(face) < 0;
  std::uint64_t dropped = 0;
  std::uint32_t before = 0;  // triangles of the runs before
  for (const TriangleRun& run : cluster.runs) {
    const std::uint32_t count = run.end - run.first;
    const auto bitsOfRun = [&](std::uint32_t set) {
      return static_cast<std::uint32_t>((std::uint64_t{set} >> before) & ((std::uint64_t{1} << count) - 1));
    };
    std::uint32_t left = bitsOfRun(sets.whole | sets.cut);
    if (left != 0) left &= ~skippedOf(run, skipped);
    for (; left != 0; left &= left - 1) {
      const auto t = static_cast<std::uint32_t>(std::countr_zero(left));
      const TriangleRun one{run.draw, run.first + t, run.first + t + 1};
      if ((bitsOfRun(sets.cut) >> t & 1) != 0)
        dropped += appendScreenTriangles(list, face, {&one, 1}, {}, triangles);
      else
        appendPlaced(mesh, part, before + t, placed, face.scissor, mirrored, run.draw, triangles);
    }
    before += count;
  }
  return dropped;
}

}  // namespace hemitex::raster
