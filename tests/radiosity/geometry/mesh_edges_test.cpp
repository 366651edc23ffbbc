// findEdges and connectedSets: a tetrahedron by hand.
#include "radiosity/geometry/mesh_edges.h"

#include <catch2/catch.hpp>

using namespace hemitex::radiosity;

namespace {

/// Faces outwards.
std::vector<TrianglePositions> tetrahedron() {
  const glm::dvec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}

}  // namespace

TEST_CASE("findEdges gives a tetrahedron six edges, each of two triangles that run along it in opposite directions",
          "[edges]") {
  const MeshEdges edges = findEdges(tetrahedron());
  REQUIRE(edges.count() == 6);
  for (std::uint32_t e = 0; e < 6; ++e) {
    const auto around = edges.around(e);
    REQUIRE(around.size() == 2);
    CHECK(around[0] / 3 != around[1] / 3);
    CHECK(edges.edge[around[0]] == e);
    CHECK(edges.vertex[around[0]] == edges.vertex[nextCorner(around[1])]);
    CHECK(edges.vertex[around[1]] == edges.vertex[nextCorner(around[0])]);
  }
}

TEST_CASE("connectedSets joins the triangles whose common edge connects them", "[edges]") {
  const std::vector<TrianglePositions> triangles = tetrahedron();
  const MeshEdges edges = findEdges(triangles);
  using Sets = std::vector<std::vector<std::uint32_t>>;
  CHECK(connectedSets(edges, [](auto, auto) { return true; }).triangles == Sets{{0, 1, 2, 3}});
  CHECK(connectedSets(edges, [](auto, auto) { return false; }).triangles == Sets{{0}, {1}, {2}, {3}});
  const TriangleSets sets = connectedSets(edges, [](auto h, auto other) { return h / 3 % 2 == other / 3 % 2; });
  CHECK(sets.triangles == Sets{{0, 2}, {1, 3}});
  CHECK(sets.owner == std::vector<std::uint32_t>{0, 1, 0, 1});
}
