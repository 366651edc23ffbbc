// The screen triangles of a cluster are those of its runs.
#include "raster/software/cluster_setup.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <tuple>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

bool operator==(const Edge& a, const Edge& b) {
  return a.a == b.a && a.b == b.b && a.c == b.c && a.inclusive == b.inclusive;
}

bool isSame(const ScreenTriangle& a, const ScreenTriangle& b) {
  return a.edges[0] == b.edges[0] && a.edges[1] == b.edges[1] && a.edges[2] == b.edges[2] && a.w == b.w && a.u == b.u &&
         a.v == b.v && a.inverseDepth == b.inverseDepth && a.area == b.area && a.draw == b.draw &&
         a.number == b.number && a.facesAway == b.facesAway && a.firstRow == b.firstRow && a.endRow == b.endRow &&
         a.firstColumn == b.firstColumn && a.endColumn == b.endColumn;
}

/// Draws without an index map, so that clusters have many runs. Some triangles have a coordinate that is not finite.
DrawList manyDraws() {
  DrawList list = tests::crossingTriangles();
  const std::vector<Draw> draws = list.draws;
  list.draws.clear();
  for (const Draw& draw : draws)
    for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 15)
      list.draws.push_back({first, std::min(15U, draw.first + draw.count - first), draw.offset, draw.back, {}});
  for (std::size_t i = 100; i < list.positions.size(); i += 1000) {
    list.positions[i].y = std::numeric_limits<float>::quiet_NaN();
    list.texcoords[i + 500].x = std::numeric_limits<float>::infinity();
  }
  return list;
}

/// Appends the small triangles as screen triangles and sorts all in draw order; returns the number of small ones.
std::size_t setUpSmall(const DrawList& list, const ClusterMesh& mesh, const Cluster& cluster, const ClusterPart& part,
                       std::uint32_t small, const PlacedVertices& placed, const Face& face,
                       std::vector<ScreenTriangle>& triangles) {
  const std::size_t before = triangles.size();
  for (std::uint32_t t = 0; t < part.triangles; ++t) {
    ScreenTriangle triangle;
    if ((small >> t & 1) != 0 &&
        makeScreenTriangle(list, mesh, cluster, part, t, placed, face.scissor, determinant(face) < 0, triangle))
      triangles.push_back(triangle);
  }
  std::stable_sort(triangles.begin(), triangles.end(), [](const ScreenTriangle& a, const ScreenTriangle& b) {
    return std::tie(a.draw, a.number) < std::tie(b.draw, b.number);
  });
  return triangles.size() - before;
}

}  // namespace

TEST_CASE("appendScreenTriangles of a cluster gives the screen triangles of its runs, with each instruction set",
          "[cluster_triangles]") {
  const std::vector<std::uint32_t> skipped{0, 3, 31, 32, 33, 64, 500, 501, 502, 503, 1999};
  for (const DrawList& list : {tests::crossingTriangles(), manyDraws()}) {
    const std::vector<Cluster> clusters = clustersOf(list);
    const ClusterMesh mesh = meshOf(list, clusters);
    std::size_t small = 0;
    for (Face face : {tests::threeFaces()[0], tests::threeFaces()[1], tests::threeFaces()[2], tests::frontFace(8)}) {
      std::size_t found = 0;
      for (const int width : {face.scissor.width, 9}) {
        face.scissor.width = width;
        for (std::size_t c = 0; c < clusters.size(); ++c) {
          std::vector<ScreenTriangle> expected;
          appendScreenTriangles(list, face, clusters[c].runs, skipped, expected);
          for (const Kernels& kernels : allKernels()) {
            INFO(kernels.instructionSet << ", cluster " << c);
            PlacedVertices vertices;
            std::vector<ScreenTriangle> triangles;
            const std::uint32_t smallOnes = appendScreenTriangles(list, mesh, clusters[c], mesh.parts[c], kernels, face,
                                                                  skipped, vertices, triangles)
                                                .small;
            small += setUpSmall(list, mesh, clusters[c], mesh.parts[c], smallOnes, vertices, face, triangles);
            REQUIRE(triangles.size() == expected.size());
            for (std::size_t t = 0; t < expected.size(); ++t) CHECK(isSame(triangles[t], expected[t]));
          }
          found += expected.size();
        }
      }
      CHECK(found > 100);
    }
    CHECK(small > 500 * allKernels().size());
  }
}
