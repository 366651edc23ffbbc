// The kernels for small triangles give the same results with each instruction set, bit for bit, and the same samples as
// screen triangles.
#include "raster/kernels/small_triangle_kernels.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <tuple>

#include "raster/kernels/interpolation_bounds.h"
#include "raster/setup/exact_interpolation.h"
#include "raster/software/cluster_setup.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

std::vector<Face> faces() {
  std::vector<Face> all{tests::frontFace(64), tests::frontFace(64), tests::frontFace(32), tests::frontFace(128)};
  all[1].x = -all[1].x;
  all[1].scissor = {17, 9, 31, 40};
  return all;
}

/// A part of the mesh in the view of a face.
struct Seen {
  PlacedVertices placed;
  std::uint32_t small;

  Seen(const ClusterMesh& mesh, const ClusterPart& part, const Face& face)
      : small(scalarKernels<VertexKernels>().place(mesh, part, face, placed).small) {}
};

/// Triangle, row, column, bits of 1/w, texel: sorted, because the kernels return samples in any order.
using Sample = std::tuple<std::int32_t, int, int, std::uint64_t, std::int32_t>;

std::vector<Sample> sorted(const SmallSamples& samples) {
  std::vector<Sample> all;
  for (std::size_t i = 0; i < samples.count; ++i)
    all.emplace_back(samples.triangles[i], samples.rows[i], samples.columns[i],
                     std::bit_cast<std::uint64_t>(samples.inverseDepths[i]), samples.texels[i]);
  std::sort(all.begin(), all.end());
  return all;
}

/// The covered samples of a screen triangle: rows and columns.
std::vector<std::pair<int, int>> coveredBy(const ScreenTriangle& triangle) {
  std::vector<std::pair<int, int>> covered;
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
      const EdgeValues edge = edgeValues(triangle, column, row), least = minCovered(triangle);
      if (edge[0] >= least[0] && edge[1] >= least[1] && edge[2] >= least[2]) covered.emplace_back(row, column);
    }
  return covered;
}

}  // namespace

TEST_CASE("SmallTriangleKernels::findSamples gives the same samples with each instruction set",
          "[small_triangle_kernels]") {
  const DrawList list = tests::smallTriangles(600);
  const ClusterMesh mesh = meshOf(list, clustersOf(list));
  std::size_t samples = 0;
  for (const Face& face : faces())
    for (const ClusterPart& part : mesh.parts)
      for (const int columns : {8, 1}) {
        const Seen seen(mesh, part, face);
        const SmallTriangles triangles{mesh, part, seen.placed, seen.small, columns, columns == 1 ? 1 : 5};
        SmallSamples plain;
        scalarKernels<SmallTriangleKernels>().findSamples(triangles, face.scissor, plain);
        samples += plain.count;
        for (const SmallTriangleKernels& kernels : simdKernels<SmallTriangleKernels>()) {
          INFO(kernels.name);
          SmallSamples found;
          kernels.findSamples(triangles, face.scissor, found);
          CHECK(sorted(found) == sorted(plain));
          for (std::size_t i = 0; i < found.count; ++i)
            CHECK((found.negative >> found.triangles[i] & 1) == (plain.negative >> found.triangles[i] & 1));
        }
      }
  CHECK(samples > 20000);
}

TEST_CASE("SmallTriangleKernels::findSamples gives the samples and texels of the screen triangle",
          "[small_triangle_kernels]") {
  const DrawList list = tests::smallTriangles(600);
  const std::vector<Cluster> clusters = clustersOf(list);
  const ClusterMesh mesh = meshOf(list, clusters);
  constexpr int rows = 5;
  int small = 0, empty = 0, decided = 0, undecided = 0;
  for (const Face& face : faces())
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      const ClusterPart& part = mesh.parts[c];
      const Seen seen(mesh, part, face);
      const bool isMirrored = determinant(face) < 0;
      for (std::uint32_t t = 0; t < part.triangles; ++t) {
        if ((seen.small >> t & 1) == 0) continue;
        ++small;
        ScreenTriangle triangle;
        std::vector<std::pair<int, int>> expected;
        if (makeScreenTriangle(mesh, clusters[c], part, t, seen.placed, face.scissor, isMirrored, triangle))
          expected = coveredBy(triangle);
        if (expected.empty()) ++empty;
        for (const int columns : {7, 1}) {
          SmallSamples found;
          scalarKernels<SmallTriangleKernels>().findSamples({mesh, part, seen.placed, 1U << t, columns, rows},
                                                            face.scissor, found);
          REQUIRE(found.count == expected.size());
          for (std::size_t i = 0; i < found.count; ++i) {
            const auto [row, column] = expected[i];
            CHECK(found.triangles[i] == static_cast<std::int32_t>(t));
            CHECK(found.rows[i] == row);
            CHECK(found.columns[i] == column);
            CHECK(((found.negative >> t & 1) != 0) == (triangle.facesAway == isMirrored));
            const double inverseDepth = inverseDepthAt(triangle, edgeValues(triangle, column, row));
            CHECK(std::abs(found.inverseDepths[i] - inverseDepth) <= 2 * depthError * inverseDepth);
            found.texels[i] == undecidedTexel ? ++undecided : ++decided;
            if (found.texels[i] != undecidedTexel)
              CHECK(found.texels[i] == texelExactly(triangle, triangle.v, rows, column, row) * columns +
                                           texelExactly(triangle, triangle.u, columns, column, row));
          }
        }
      }
    }
  CHECK(small > 5000);
  CHECK(empty > 500);
  CHECK(decided > 5000);
  CHECK(undecided > 100);
}

TEST_CASE("SmallTriangleKernels::findSamples finds one of the four smallest triangles around a sample",
          "[small_triangle_kernels]") {
  // Half a square of 1/256 pixel in each quadrant of the sample of column 10 and row 12, at w = 1.
  const Face face = tests::frontFace(64);
  constexpr float step = 1 / 8192.0f;
  const glm::vec3 sample(10.5f / 32 - 1, 12.5f / 32 - 1, 1);
  DrawList list;
  list.format = {{8, 8, 8}};
  tests::addDraw(list, 1, std::nullopt, std::nullopt);
  const std::array<glm::vec3, 4> sides{{{step, 0, 0}, {0, step, 0}, {-step, 0, 0}, {0, -step, 0}}};
  for (std::size_t k = 0; k < 4; ++k)
    tests::addTriangle(list, {sample, sample + sides[k], sample + sides[(k + 1) % 4]});
  const std::vector<Cluster> clusters = clustersOf(list);
  const ClusterMesh mesh = meshOf(list, clusters);
  REQUIRE(mesh.parts.size() == 1);
  const Seen seen(mesh, mesh.parts[0], face);
  REQUIRE(seen.small == 0b1111);
  SmallSamples found;
  scalarKernels<SmallTriangleKernels>().findSamples({mesh, mesh.parts[0], seen.placed, seen.small, 1, 1}, face.scissor,
                                                    found);
  REQUIRE(found.count == 1);
  CHECK(found.columns[0] == 10);
  CHECK(found.rows[0] == 12);
}
