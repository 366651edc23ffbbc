// neighbours and oppositeCorner: small meshes by hand, and random meshes against a search of all pairs of edges.
#include "radiosity/discretization/neighbours.h"

#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

using Neighbours = std::vector<std::array<std::uint32_t, 3>>;
constexpr std::uint32_t none = noNeighbour;

/// A surface of triangles given by the numbers of their corners.
Surface mesh(const std::vector<glm::dvec3>& points, const std::vector<std::array<std::size_t, 3>>& triangles) {
  std::vector<Triangle> result;
  for (const auto& [a, b, c] : triangles) result.emplace_back().position = {points[a], points[b], points[c]};
  return tests::surfaceOf("mesh", std::move(result));
}

const std::vector<glm::dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};

/// The ends of the edge opposite to a corner.
std::pair<glm::dvec3, glm::dvec3> edgeOf(const Triangle& triangle, std::size_t corner) {
  return {triangle.position[(corner + 1) % 3], triangle.position[(corner + 2) % 3]};
}

bool isSameEdge(const std::pair<glm::dvec3, glm::dvec3>& e, const std::pair<glm::dvec3, glm::dvec3>& f) {
  return (e.first == f.first && e.second == f.second) || (e.first == f.second && e.second == f.first);
}

/// For each edge, the next triangle with this edge after its own one; the first again after the last.
Neighbours searchedNeighbours(const Surface& surface) {
  const std::size_t count = surface.triangles.size();
  Neighbours result(count, {none, none, none});
  for (std::size_t corner = 0; corner < 3 * count; ++corner)
    for (std::size_t step = 1; step < 3 * count; ++step) {
      const std::size_t other = (corner + step) % (3 * count);
      if (!isSameEdge(edgeOf(surface.triangles[corner / 3], corner % 3),
                      edgeOf(surface.triangles[other / 3], other % 3)))
        continue;
      result[corner / 3][corner % 3] = static_cast<std::uint32_t>(other / 3);
      break;
    }
  return result;
}

}  // namespace

TEST_CASE("neighbours are the triangles across the edges opposite to the corners", "[mesh]") {
  CHECK(neighbours(mesh(square, {})).empty());
  CHECK(neighbours(mesh(square, {{0, 1, 2}})) == Neighbours{{none, none, none}});
  CHECK(neighbours(mesh(square, {{0, 1, 2}, {0, 2, 3}})) == Neighbours{{none, 1, none}, {none, none, 0}});
  // The direction of an edge does not matter.
  CHECK(neighbours(mesh(square, {{0, 1, 2}, {2, 0, 3}})) == Neighbours{{none, 1, none}, {none, none, 0}});
  // A common corner is no common edge.
  CHECK(neighbours(mesh(square, {{0, 1, 4}, {2, 3, 4}})) == Neighbours{{none, none, none}, {none, none, none}});
}

TEST_CASE("neighbours of a closed mesh are complete", "[mesh]") {
  CHECK(neighbours(mesh(square, {{1, 2, 4}, {2, 0, 4}, {0, 1, 4}, {0, 2, 1}})) ==
        Neighbours{{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}});
}

TEST_CASE("neighbours at an edge of more than two triangles are a cycle in the order of the triangles", "[mesh]") {
  CHECK(neighbours(mesh(square, {{0, 1, 2}, {0, 1, 3}, {4, 1, 0}})) ==
        Neighbours{{none, none, 1}, {none, none, 2}, {0, none, none}});
}

TEST_CASE("neighbours compares positions by value", "[mesh]") {
  std::vector<glm::dvec3> points = square;
  points.push_back({-0.0, 0, -0.0});
  points.push_back({0x1p-1074, 0, 0});
  CHECK(neighbours(mesh(points, {{0, 1, 2}, {5, 2, 3}})) == Neighbours{{none, 1, none}, {none, none, 0}});
  CHECK(neighbours(mesh(points, {{0, 1, 2}, {6, 2, 3}})) == Neighbours{{none, none, none}, {none, none, none}});
}

TEST_CASE("neighbours equals a search of all pairs of edges, and oppositeCorner finds the edge again", "[mesh]") {
  std::mt19937 random(4);
  for (int k = 0; k < 300; ++k) {
    std::vector<glm::dvec3> points(4 + random() % 12);
    for (glm::dvec3& point : points) point = {random() % 3, random() % 3, random() % 1000};
    std::vector<std::array<std::size_t, 3>> triangles(1 + random() % 30);
    for (auto& triangle : triangles) do
        for (std::size_t& corner : triangle) corner = random() % points.size();
      while (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]);
    const Surface surface = mesh(points, triangles);
    const Neighbours found = neighbours(surface);
    REQUIRE(found == searchedNeighbours(surface));
    for (std::size_t t = 0; t < found.size(); ++t)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        if (found[t][corner] == none) continue;
        const Triangle &triangle = surface.triangles[t], &other = surface.triangles[found[t][corner]];
        REQUIRE(isSameEdge(edgeOf(triangle, corner), edgeOf(other, oppositeCorner(triangle, corner, other))));
      }
  }
}

TEST_CASE("oppositeCorner is the corner of the other triangle that is not on the common edge", "[mesh]") {
  const Surface surface = mesh(square, {{0, 1, 2}, {0, 2, 3}, {3, 2, 0}, {2, 3, 0}});
  const auto corner = [&](std::size_t other) {
    return oppositeCorner(surface.triangles[0], 1, surface.triangles[other]);
  };
  CHECK(corner(1) == 2);
  CHECK(corner(2) == 0);
  CHECK(corner(3) == 1);
}
