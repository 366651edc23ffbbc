// The small triangle kernels of every instruction set compute what the plain ones do, bit for bit, and the plain ones
// draw what screen triangles do.
#include "raster/small_triangle_kernels.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <tuple>

#include "raster/cluster_triangles.h"
#include "raster/exact.h"
#include "raster/pixel_bounds.h"
#include "tests/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

std::vector<Face> faces() {
  std::vector<Face> all{tests::frontFace(64), tests::frontFace(64), tests::frontFace(32)};
  all[1].x = -all[1].x;
  all[1].scissor = {17, 9, 31, 40};
  return all;
}

/// A part of the mesh as a face sees it.
struct Seen {
  PlacedVertices placed;
  std::uint32_t small;

  Seen(const ClusterMesh& mesh, const ClusterPart& part, const Face& face)
      : small(plainVertexKernels().place(mesh, part, face, placed).small) {}
};

using Undecided = std::vector<std::tuple<std::uint32_t, int, int>>;

/// In an order of its own: that in which kernels list samples is theirs.
Undecided sorted(const UndecidedSamples& undecided) {
  Undecided all;
  for (const auto& [number, pixel] : undecided.samples) all.emplace_back(number, pixel.row, pixel.column);
  std::sort(all.begin(), all.end());
  return all;
}

struct Drawn {
  DepthBuffer buffer;
  std::vector<bool> taken;
  UndecidedSamples undecided;
};

/// Each part twice, so that its second time is undecided wherever it is in front.
Drawn draw(const SmallTriangleKernels& kernels, const ClusterMesh& mesh, const Face& face) {
  Drawn drawn{DepthBuffer(face.scissor), {}, {}};
  std::uint32_t number = 0;
  for (const ClusterPart& part : mesh.parts) {
    const Seen seen(mesh, part, face);
    for (int time = 0; time < 2; ++time)
      drawn.taken.push_back(
          kernels.offer({mesh, part, seen.placed, seen.small, number}, drawn.buffer, drawn.undecided));
    number += largestCluster;
  }
  return drawn;
}

/// The buffer's bits, without what is behind the end of a row.
std::vector<std::uint64_t> bitsOf(const DepthBuffer& buffer) {
  std::vector<std::uint64_t> bits;
  for (int row = buffer.scissor.row; row < buffer.scissor.row + buffer.scissor.height; ++row)
    for (int column = buffer.scissor.column; column < buffer.scissor.column + buffer.scissor.width; ++column) {
      bits.push_back(std::bit_cast<std::uint64_t>(buffer.inverseDepth[buffer.pixelAt(column, row)]));
      bits.push_back(buffer.triangle[buffer.pixelAt(column, row)]);
    }
  return bits;
}

/// Pixels of a triangle, all alike.
SmallPixels pixelsOf(const ScreenTriangle& triangle, const std::array<std::array<int, 2>, 3>& snapped, int columns,
                     int rows, const std::vector<Pixel>& pixels) {
  SmallPixels all{};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    all.columns[i] = columns;
    all.rows[i] = rows;
    for (std::size_t k = 0; k < 3; ++k) {
      all.across[k][i] = static_cast<float>(snapped[k][0] - (256 * pixels[i].column + 128));
      all.down[k][i] = static_cast<float>(snapped[k][1] - (256 * pixels[i].row + 128));
      all.w[k][i] = static_cast<float>(triangle.w[k]);
      all.u[k][i] = static_cast<float>(triangle.u[k]);
      all.v[k][i] = static_cast<float>(triangle.v[k]);
    }
  }
  return all;
}

}  // namespace

TEST_CASE("small triangles take the same pixels with every instruction set", "[small_triangle_kernels]") {
  const DrawList list = tests::smallTriangles(600);
  const ClusterMesh mesh = meshOf(list, clustersOf(list));
  for (const Face& face : faces()) {
    const Drawn plain = draw(plainSmallTriangleKernels(), mesh, face);
    CHECK(std::count(plain.taken.begin(), plain.taken.end(), true) > 100);
    CHECK(plain.undecided.samples.size() > 100);
    for (const SmallTriangleKernels& kernels : simdSmallTriangleKernels()) {
      INFO(kernels.name);
      const Drawn drawn = draw(kernels, mesh, face);
      CHECK(bitsOf(drawn.buffer) == bitsOf(plain.buffer));
      CHECK(drawn.taken == plain.taken);
      CHECK(sorted(drawn.undecided) == sorted(plain.undecided));
    }
  }
}

TEST_CASE("a small triangle covers the samples of its screen triangle and has its texels", "[small_triangle_kernels]") {
  const DrawList list = tests::smallTriangles(600);
  const std::vector<Cluster> clusters = clustersOf(list);
  const ClusterMesh mesh = meshOf(list, clusters);
  std::vector<SmallTriangleKernels> all = simdSmallTriangleKernels();
  all.push_back(plainSmallTriangleKernels());
  int small = 0, empty = 0, decided = 0, undecided = 0;
  for (const Face& face : faces())
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      const ClusterPart& part = mesh.parts[c];
      const Seen seen(mesh, part, face);
      for (std::uint32_t t = 0; t < part.triangles; ++t) {
        if ((seen.small >> t & 1) == 0) continue;
        ++small;
        DepthBuffer expected(face.scissor), buffer(face.scissor);
        ScreenTriangle triangle;
        UndecidedPixels none;
        UndecidedSamples noneSmall;
        const bool isSeen = makeScreenTriangle(mesh, clusters[c], part, t, seen.placed, face.scissor,
                                               determinant(face) < 0, triangle) &&
                            plainKernels().offer(triangle, t, expected, none);
        CHECK(plainSmallTriangleKernels().offer({mesh, part, seen.placed, 1U << t, 0}, buffer, noneSmall) == isSeen);
        REQUIRE(buffer.triangle == expected.triangle);
        if (!isSeen) {
          ++empty;
          continue;
        }
        std::vector<Pixel> pixels;
        for (int row = triangle.firstRow; row < triangle.endRow; ++row)
          for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
            const std::size_t p = buffer.pixelAt(column, row);
            if (buffer.triangle[p] != t) continue;
            const double error = buffer.inverseDepth[p] - expected.inverseDepth[p];
            CHECK(std::abs(error) <= 2 * depthError * expected.inverseDepth[p]);
            if (pixels.size() < mostSmallPixels - 1) pixels.push_back({column, row});
          }
        std::array<std::array<int, 2>, 3> snapped;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t corner = mesh.corners[k][part.firstTriangle + t];
          snapped[k] = {seen.placed.across[corner], seen.placed.down[corner]};
        }
        constexpr int rows = 5;
        for (const int columns : {7, 1}) {
          const SmallPixels shown = pixelsOf(triangle, snapped, columns, rows, pixels);
          const SmallTexels plain = plainSmallTriangleKernels().findTexels(shown, pixels.size());
          for (std::size_t i = 0; i < pixels.size(); ++i) {
            const auto exactly = [&](const std::array<double, 3>& coordinate, int size) {
              return texelExactly(triangle, coordinate, size, pixels[i].column, pixels[i].row);
            };
            CHECK(((plain.negative >> i & 1) != 0) == (triangle.facesAway == (determinant(face) < 0)));
            (plain.decided >> i & 1) != 0 ? ++decided : ++undecided;
            if ((plain.decided >> i & 1) != 0)
              CHECK(static_cast<int>(plain.texels[i]) ==
                    exactly(triangle.v, rows) * columns + exactly(triangle.u, columns));
          }
          for (const SmallTriangleKernels& kernels : all) {
            INFO(kernels.name);
            const SmallTexels found = kernels.findTexels(shown, pixels.size());
            const std::uint32_t mask = (1U << pixels.size()) - 1;
            CHECK((found.decided & mask) == plain.decided);
            CHECK((found.negative & mask) == plain.negative);
            for (std::size_t i = 0; i < pixels.size(); ++i)
              if ((plain.decided >> i & 1) != 0) CHECK(found.texels[i] == plain.texels[i]);
          }
        }
      }
    }
  CHECK(small > 5000);
  CHECK(empty > 500);
  CHECK(decided > 5000);
  CHECK(undecided > 100);
}
