// findShells: what encloses a solid, a room or nothing, whatever else shares its edges.
#include "radiosity/geometry/shells.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace hemitex::radiosity;

namespace {

using Triangles = std::vector<TrianglePositions>;

void append(Triangles& triangles, const Triangles& more) {
  triangles.insert(triangles.end(), more.begin(), more.end());
}

/// Two triangles.
Triangles quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return {{a, b, c}, {a, c, d}};
}

/// The sides of a box that face outwards, the bottom last.
Triangles box(const glm::dvec3& low, const glm::dvec3& high, std::size_t sides = 6) {
  const auto at = [&](int i) {
    return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  };
  Triangles triangles;
  const Triangles all[]{quad(at(4), at(5), at(7), at(6)), quad(at(1), at(0), at(2), at(3)),
                        quad(at(5), at(1), at(3), at(7)), quad(at(0), at(4), at(6), at(2)),
                        quad(at(6), at(7), at(3), at(2)), quad(at(0), at(1), at(5), at(4))};
  for (std::size_t side = 0; side < sides; ++side) append(triangles, all[side]);
  return triangles;
}

Triangles reversed(Triangles triangles) {
  for (TrianglePositions& triangle : triangles) std::swap(triangle[1], triangle[2]);
  return triangles;
}

Triangles joined(Triangles one, const Triangles& other) {
  append(one, other);
  return one;
}

void checkOne(const Triangles& triangles, ShellKind kind, bool isClosed) {
  const Shells shells = findShells(triangles);
  REQUIRE(shells.kinds.size() == 1);
  CHECK(shells.kinds[0] == kind);
  CHECK(shells.isClosed[0] == isClosed);
}

}  // namespace

TEST_CASE("findShells tells solids, rooms and sheets, closed and open", "[shells]") {
  const Triangles solid = box({0, 0, 0}, {3, 1, 2});
  checkOne(solid, ShellKind::Solid, true);
  checkOne(reversed(solid), ShellKind::Room, true);
  checkOne(box({0, 0, 0}, {3, 1, 2}, 5), ShellKind::Solid, false);
  checkOne(reversed(box({0, 0, 0}, {3, 1, 2}, 5)), ShellKind::Room, false);
  const Triangles sheet = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  checkOne(sheet, ShellKind::Sheet, false);
  checkOne(joined(sheet, reversed(sheet)), ShellKind::Sheet, true);
}

TEST_CASE("findShells does not depend on how one side is divided", "[shells]") {
  // The side at x = 3 in four quads, whose middles lie on the edges of the others.
  Triangles triangles;
  for (const TrianglePositions& triangle : box({0, 0, 0}, {3, 1, 2}))
    if (!std::all_of(triangle.begin(), triangle.end(), [](const glm::dvec3& p) { return p.x == 3; }))
      triangles.push_back(triangle);
  for (const double y : {0.0, 0.5})
    for (const double z : {0.0, 1.0})
      append(triangles, quad({3, y, z}, {3, y + 0.5, z}, {3, y + 0.5, z + 1}, {3, y, z + 1}));
  checkOne(triangles, ShellKind::Solid, true);
  checkOne(reversed(triangles), ShellKind::Room, true);
  triangles.pop_back();
  checkOne(triangles, ShellKind::Solid, false);
}

TEST_CASE("findShells names the faces that look the other way", "[shells]") {
  for (const std::size_t first : {std::size_t{0}, std::size_t{6}}) {
    Triangles triangles = box({0, 0, 0}, {3, 1, 2});
    std::swap(triangles[first][1], triangles[first][2]);
    std::swap(triangles[first + 1][1], triangles[first + 1][2]);
    checkOne(triangles, ShellKind::Solid, true);
    const Shells shells = findShells(triangles);
    for (std::size_t t = 0; t < triangles.size(); ++t) CHECK(shells.isTurnedOver[t] == (t == first || t == first + 1));
  }
}

TEST_CASE("findShells keeps solids apart that touch at edges or faces", "[shells]") {
  const Triangles one = box({0, 0, 0}, {1, 1, 1});
  for (const glm::dvec3& shift : {glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
    const Triangles other = box(shift, shift + 1.0);
    const Shells shells = findShells(joined(one, other));
    // Any closed division is right; at an edge alone it is that of the boxes.
    for (const bool isClosed : shells.isClosed) CHECK(isClosed);
    CHECK(std::count(shells.kinds.begin(), shells.kinds.end(), ShellKind::Solid) > 0);
    CHECK(std::count(shells.kinds.begin(), shells.kinds.end(), ShellKind::Room) == 0);
    if (shift == glm::dvec3(1, 1, 0)) CHECK(shells.kinds.size() == 2);
    const Shells rooms = findShells(reversed(joined(one, other)));
    CHECK(std::count(rooms.kinds.begin(), rooms.kinds.end(), ShellKind::Room) > 0);
    CHECK(std::count(rooms.kinds.begin(), rooms.kinds.end(), ShellKind::Solid) == 0);
  }
}
