#include "raster/kernels/vertex_kernels.h"

#include <algorithm>
#include <cmath>

#include "raster/setup/triangle_setup.h"
#include "raster/setup/vertex_stage.h"

namespace hemitex::raster {
namespace {

/// Comparing x with 2w or 8w is exact in binary32: if the product overflows, it is larger than all x.
std::int32_t sidesOf(const ViewVertex& p, double nearDistance) {
  if (!isFinite(p)) return notInside;
  const double width = 2 * std::abs(p.w);
  const bool isInside = std::all_of(halfSpaces.begin(), halfSpaces.end(),
                                    [&](HalfSpace halfSpace) { return distance(halfSpace, p, nearDistance) >= 0; });
  return (p.w < nearDistance ? beyondNear : 0) | (p.x > width ? beyondRight : 0) | (-p.x > width ? beyondLeft : 0) |
         (p.y > width ? beyondBottom : 0) | (-p.y > width ? beyondTop : 0) | (isInside ? 0 : notInside);
}

void placeVertices(const ClusterMesh& mesh, const ClusterPart& part, const Face& face, PlacedVertices& placed) {
  for (std::size_t i = 0; i < part.vertices; ++i) {
    const std::size_t v = part.firstVertex + i;
    const ViewVertex p = transform(face, {mesh.positions[0][v], mesh.positions[1][v], mesh.positions[2][v]}, {});
    placed.w[i] = static_cast<float>(p.w);
    placed.sides[i] = sidesOf(p, face.nearDistance);
    const bool isInside = (placed.sides[i] & notInside) == 0;
    placed.across[i] = isInside ? static_cast<std::int32_t>(snap(p.x / p.w, face.resolution)) : 0;
    placed.down[i] = isInside ? static_cast<std::int32_t>(snap(p.y / p.w, face.resolution)) : 0;
  }
}

/// The number of pixels of [first, first + count) whose samples lie between three snapped values.
int samplesIn(const std::array<std::int32_t, 3>& values, int first, int count) {
  const PixelRange range = samplesBetween(values[0], values[1], values[2], first, first + count);
  return std::max(range.end - range.first, 0);
}

bool areSmall(const std::array<std::int32_t, 3>& values) {
  const auto [least, largest] = std::minmax({values[0], values[1], values[2]});
  return largest - least < smallSpan;
}

TriangleSets place(const ClusterMesh& mesh, const ClusterPart& part, const Face& face, PlacedVertices& placed) {
  placeVertices(mesh, part, face, placed);
  TriangleSets sets;
  for (std::uint32_t t = 0; t < part.triangles; ++t) {
    const std::size_t a = mesh.corners[0][part.firstTriangle + t], b = mesh.corners[1][part.firstTriangle + t],
                      c = mesh.corners[2][part.firstTriangle + t];
    if ((placed.sides[a] & placed.sides[b] & placed.sides[c] & beyondAny) != 0) continue;
    if (((placed.sides[a] | placed.sides[b] | placed.sides[c]) & notInside) != 0) {
      sets.cut |= 1U << t;
      continue;
    }
    const std::array across{placed.across[a], placed.across[b], placed.across[c]};
    const std::array down{placed.down[a], placed.down[b], placed.down[c]};
    const int columns = samplesIn(across, face.scissor.column, face.scissor.width);
    const int rows = samplesIn(down, face.scissor.row, face.scissor.height);
    if (columns == 0 || rows == 0) continue;
    sets.whole |= 1U << t;
    if (!areSmall(across) || !areSmall(down)) continue;
    sets.small |= 1U << t;
    if (columns <= 2 && rows <= 2) sets.tiny |= 1U << t;
  }
  return sets;
}

}  // namespace

template <>
const VertexKernels& scalarKernels<VertexKernels>() {
  static const VertexKernels kernels{"scalar", place};
  return kernels;
}

}  // namespace hemitex::raster
