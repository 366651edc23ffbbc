// The rules as functions: kept vertices, crossings on edges, equal crossings for neighbours, edges, ties, and texels
// that double precision does not resolve.
#include "raster/plain/rules.h"

#include <catch2/catch.hpp>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using raster::ViewVertex;

namespace {

/// The doubled area of a polygon in the plane w = 1.
double fanArea(const raster::ClippedPolygon& polygon) {
  double area = 0;
  for (std::size_t k = 2; k < polygon.count; ++k) {
    const ViewVertex &a = polygon.vertices[0], &b = polygon.vertices[k - 1], &c = polygon.vertices[k];
    area += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  return area;
}

}  // namespace

TEST_CASE("view multiplies the rows of the view with the offset from the eye", "[clip]") {
  raster::Face face = tests::frontFace(64);
  face.eye = {1, 2, 3};
  face.x = {0, 0, 1};
  face.y = {2, 0, 0};
  face.w = {0, 1, 0};
  const ViewVertex vertex = raster::view(face, {11, 22, 33}, {0.25f, 0.75f});
  CHECK(vertex.x == 30);
  CHECK(vertex.y == 20);
  CHECK(vertex.w == 20);
  CHECK(vertex.u == 0.25);
  CHECK(vertex.v == 0.75);
}

TEST_CASE("clip keeps a triangle inside all half-spaces unchanged", "[clip]") {
  const std::array<ViewVertex, 3> triangle{{{0, 0, 1, 0, 0}, {8, 0, 1, 1, 0}, {0, -8, 1, 0, 1}}};
  const raster::ClippedPolygon polygon = raster::clip(triangle, 1);
  REQUIRE(polygon.count == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(polygon.vertices[k].x == triangle[k].x);
    CHECK(polygon.vertices[k].y == triangle[k].y);
  }
}

TEST_CASE("clip cuts an edge at the near plane where w = n, and stores exactly n", "[clip]") {
  // From (0, 0, w = 2) to w = -1 and w = -2: w = 0.5 is at 1/2 and 3/8 of the way.
  const std::array<ViewVertex, 3> triangle{{{0, 0, 2, 0, 0}, {3, 0, -1, 1, 0}, {0, 2, -2, 0, 1}}};
  const raster::ClippedPolygon polygon = raster::clip(triangle, 0.5);
  REQUIRE(polygon.count == 3);
  CHECK(polygon.vertices[1].w == 0.5);
  CHECK(polygon.vertices[1].x == 1.5);
  CHECK(polygon.vertices[1].u == 0.5);
  CHECK(polygon.vertices[2].w == 0.5);
  CHECK(polygon.vertices[2].y == 0.75);
  CHECK(polygon.vertices[2].v == 0.375);
}

TEST_CASE("clip starts the polygon at the first vertex that its loop emits", "[clip]") {
  // The first vertex is behind the near plane: the loop emits the crossing on the edge v0 v1 first, then v1.
  const std::array<ViewVertex, 3> triangle{{{0, 0, -1, 0, 0}, {1, 0, 3, 1, 0}, {0, 1, 3, 0, 1}}};
  const raster::ClippedPolygon polygon = raster::clip(triangle, 1);
  REQUIRE(polygon.count == 4);
  CHECK(polygon.vertices[0].w == 1);
  CHECK(polygon.vertices[0].x == 0.5);
  CHECK(polygon.vertices[1].x == 1);
  CHECK(polygon.vertices[2].y == 1);
  CHECK(polygon.vertices[3].w == 1);
}

TEST_CASE("clip cuts a triangle around the view to the square of the guard band", "[clip]") {
  // At w = 1 the guard band is the square of side 16 around the axis: doubled area 512.
  const std::array<ViewVertex, 3> triangle{{{-100, -100, 1, 0, 0}, {300, -100, 1, 0, 0}, {-100, 300, 1, 0, 0}}};
  CHECK(fanArea(raster::clip(triangle, 0.1)) == Approx(512).epsilon(1e-12));
}

TEST_CASE("clip cuts an edge at the same point for both of its triangles", "[clip]") {
  std::mt19937 random(7);
  bool holds = true;
  for (int repeat = 0; repeat < 2000; ++repeat) {
    const auto vertex = [&](float w) {
      return ViewVertex{tests::uniform(random, -10, 10), tests::uniform(random, -10, 10), w,
                        tests::uniform(random, 0, 1), tests::uniform(random, 0, 1)};
    };
    const ViewVertex inside = vertex(tests::uniform(random, 3, 9));
    const ViewVertex outside = vertex(tests::uniform(random, -9, 0));
    const ViewVertex left = vertex(tests::uniform(random, 3, 9)), right = vertex(tests::uniform(random, 3, 9));
    const auto crossings = [](const raster::ClippedPolygon& polygon) {
      std::vector<std::array<double, 4>> found;
      for (std::size_t k = 0; k < polygon.count; ++k)
        if (const ViewVertex& p = polygon.vertices[k]; p.w == 2) found.push_back({p.x, p.y, p.u, p.v});
      return found;
    };
    // Only the near plane at w = 2 cuts: |x|, |y| <= 10 < 8 * 2 is inside the guard band.
    const auto one = crossings(raster::clip({{inside, outside, left}}, 2));
    const auto two = crossings(raster::clip({{outside, inside, right}}, 2));
    bool shared = false;
    for (const auto& a : one)
      for (const auto& b : two) shared |= a == b;
    holds &= shared && one.size() == 2 && two.size() == 2;
  }
  CHECK(holds);
}

TEST_CASE("snap puts y = -w into row 0, and clamps to the guard band", "[rules]") {
  const raster::SnappedPoint first = raster::snap(ViewVertex{-3, -3, 3, 0, 0}, 64);
  CHECK(first.x == 0);
  CHECK(first.y == 0);
  CHECK(raster::snap(0, 64) == 32 * 256);
  CHECK(raster::snap(100, 64) == raster::snap(8, 64));
}

TEST_CASE("covers gives a sample on an edge to the triangle whose top or left edge it is", "[rules]") {
  // The samples of a square of 2 x 2 pixels are its corners, and its diagonal.
  const raster::SnappedPoint a = raster::sampleOf(0, 0), b = raster::sampleOf(2, 0), c = raster::sampleOf(2, 2),
                             d = raster::sampleOf(0, 2);
  const raster::Face face = tests::frontFace(64);
  for (const bool reversed : {false, true}) {
    const auto triangle = [&](const auto& p, const auto& q, const auto& r) {
      return raster::snappedTriangle({}, face, {}, {p, reversed ? r : q, reversed ? q : r});
    };
    const raster::SnappedTriangle upper = triangle(a, b, c), lower = triangle(a, c, d);
    CHECK(upper.facesAway == lower.facesAway);
    const auto isCovered = [](const raster::SnappedTriangle& one, int column, int row) {
      return covers(one, weightsAt(one, raster::sampleOf(column, row)));
    };
    CHECK(isCovered(upper, 1, 0));        // top
    CHECK(isCovered(lower, 0, 1));        // left
    CHECK(isCovered(upper, 1, 1));        // the diagonal is the left edge of the upper triangle
    CHECK_FALSE(isCovered(lower, 1, 1));  // and the right edge of the lower one
    CHECK_FALSE(isCovered(upper, 2, 1));  // right
    CHECK_FALSE(isCovered(lower, 1, 2));  // bottom
  }
  CHECK(raster::kindOf({1, 0}) == raster::EdgeKind::Top);
  CHECK(raster::kindOf({1, -1}) == raster::EdgeKind::Left);
  CHECK(raster::kindOf({-1, 0}) == raster::EdgeKind::Other);
}

TEST_CASE("isNearer and texelAt decide what double precision does not resolve", "[rules]") {
  const raster::Face face = tests::frontFace(64);
  const auto wall = [&](double w, double u) {
    return raster::snappedTriangle({}, face, {{{0, 0, w, u, 0}, {0, 0, w, u, 0}, {0, 0, w, u, 0}}},
                                   {{{0, 0}, {7 * 256, 0}, {0, 5 * 256}}});
  };
  const auto at = [](const raster::SnappedTriangle& triangle) {
    return coveredSample(triangle, weightsAt(triangle, raster::sampleOf(1, 1)));
  };
  const raster::SnappedTriangle near = wall(3, 1.0 / 3), far = wall(3 + 0x1p-51, std::nextafter(0.25, 0.0));
  CHECK(isNearer(at(near), at(far)));
  CHECK_FALSE(isNearer(at(far), at(near)));
  CHECK_FALSE(isNearer(at(near), at(near)));
  CHECK(texelAt(at(far), &ViewVertex::u, 4) == 0);
  CHECK(texelAt(at(wall(3, 0.25)), &ViewVertex::u, 4) == 1);
}
