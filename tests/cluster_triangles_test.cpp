// The screen triangles of a cluster are those of its runs.
#include "raster/cluster_triangles.h"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

bool operator==(const Edge& a, const Edge& b) {
  return a.a == b.a && a.b == b.b && a.c == b.c && a.inclusive == b.inclusive;
}

bool isSame(const ScreenTriangle& a, const ScreenTriangle& b) {
  return a.edges[0] == b.edges[0] && a.edges[1] == b.edges[1] && a.edges[2] == b.edges[2] && a.w == b.w && a.u == b.u &&
         a.v == b.v && a.inverseDepth == b.inverseDepth && a.area == b.area && a.draw == b.draw &&
         a.facesAway == b.facesAway && a.firstRow == b.firstRow && a.endRow == b.endRow &&
         a.firstColumn == b.firstColumn && a.endColumn == b.endColumn;
}

/// Triangles without an index map, so that clusters have many runs; some with a coordinate that is not finite.
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

}  // namespace

TEST_CASE("a cluster's screen triangles are those of its runs, with every instruction set", "[cluster_triangles]") {
  std::vector<VertexKernels> all = simdVertexKernels();
  all.push_back(plainVertexKernels());
  const std::vector<std::uint32_t> skipped{0, 3, 31, 32, 33, 64, 500, 501, 502, 503, 1999};
  for (const DrawList& list : {tests::crossingTriangles(), manyDraws()}) {
    const std::vector<Cluster> clusters = clustersOf(list);
    const ClusterMesh mesh = meshOf(list, clusters);
    for (Face face : tests::threeFaces()) {
      std::size_t found = 0;
      std::uint64_t dropped = 0;
      for (const int width : {face.scissor.width, 9}) {
        face.scissor.width = width;
        for (std::size_t c = 0; c < clusters.size(); ++c) {
          std::vector<ScreenTriangle> expected;
          const std::uint64_t droppedOfRuns = appendScreenTriangles(list, face, clusters[c].runs, skipped, expected);
          for (const VertexKernels& kernels : all) {
            INFO(kernels.name << ", cluster " << c);
            std::vector<ScreenTriangle> triangles;
            CHECK(appendScreenTriangles(list, mesh, clusters[c], mesh.parts[c], kernels, face, skipped, triangles) ==
                  droppedOfRuns);
            REQUIRE(triangles.size() == expected.size());
            for (std::size_t t = 0; t < expected.size(); ++t) CHECK(isSame(triangles[t], expected[t]));
          }
          found += expected.size();
          dropped += droppedOfRuns;
        }
      }
      CHECK(found > 100);
      CHECK((dropped > 0) == !list.draws.front().indexMap.has_value());
    }
  }
}
