// meshOf keeps the triangles of the draws, vertex by vertex.
#include "raster/culling/cluster_mesh.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

/// A sheet of columns x rows squares, in which six triangles share each inner vertex.
DrawList sheet(std::uint32_t columns, std::uint32_t rows) {
  DrawList list = tests::plainList();
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) {
      list.positions.emplace_back(i, j, 9);
      list.texcoords.emplace_back(i, 2 * j);
    }
  const std::uint32_t pitch = columns + 1;
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * pitch + i, b = a + 1, c = a + pitch, d = c + 1;
      list.indices.insert(list.indices.end(), {a, b, d, a, d, c});
    }
  list.draws.push_back({0, static_cast<std::uint32_t>(list.indices.size()), 1, {}, {}});
  return list;
}

}  // namespace

TEST_CASE("ClusterMesh has the corners of each triangle, and each vertex of a cluster once", "[cluster_mesh]") {
  for (const DrawList& list : {sheet(16, 9), tests::crossingTriangles()}) {
    const std::vector<Cluster> clusters = clustersOf(list);
    const ClusterMesh mesh = meshOf(list, clusters);
    REQUIRE(mesh.parts.size() == clusters.size());
    std::size_t number = 0;
    for (const ClusterPart& part : mesh.parts) {
      std::set<std::array<float, 5>> vertices;
      for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t, ++number)
        for (std::size_t k = 0; k < 3; ++k) {
          REQUIRE(mesh.corners[k][t] < part.vertices);
          const std::size_t v = part.firstVertex + mesh.corners[k][t];
          const glm::vec3 position(mesh.positions[0][v], mesh.positions[1][v], mesh.positions[2][v]);
          CHECK(position == list.positions[list.indices[3 * number + k]]);
          CHECK(mesh.texcoords[v] == list.texcoords[list.indices[3 * number + k]]);
          vertices.insert({position.x, position.y, position.z, mesh.texcoords[v].x, mesh.texcoords[v].y});
        }
      CHECK(part.vertices == vertices.size());
    }
    CHECK(number == list.indices.size() / 3);
  }
}

// 32 triangles of a sheet 16 squares wide are one row of squares, with 2 x 17 vertices instead of 96.
TEST_CASE("meshOf merges the shared vertices of a sheet", "[cluster_mesh]") {
  const DrawList shared = sheet(16, 9);
  DrawList apart = shared;  // with one vertex per corner
  apart.positions.clear();
  apart.texcoords.clear();
  for (std::uint32_t& index : apart.indices) {
    apart.positions.push_back(shared.positions[index]);
    apart.texcoords.push_back(shared.texcoords[index]);
    index = static_cast<std::uint32_t>(apart.positions.size() - 1);
  }
  for (const DrawList& list : {shared, apart}) {
    const ClusterMesh mesh = meshOf(list, clustersOf(list));
    CHECK(mesh.parts.size() == 9);
    for (const ClusterPart& part : mesh.parts) CHECK(part.vertices == 34);
  }
}
