// transform and clip: kept vertices, crossings on edges, and equal crossings for neighbours.
#include "raster/setup/vertex_stage.h"

#include <catch2/catch.hpp>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using raster::ViewVertex;

namespace {

/// The doubled area of a polygon in the plane w = 1.
double fanArea(const raster::ClippedPolygon& polygon) {
  double area = 0;
  for (std::size_t k = 2; k < static_cast<std::size_t>(polygon.count); ++k) {
    const ViewVertex &a = polygon.vertices[0], &b = polygon.vertices[k - 1], &c = polygon.vertices[k];
    area += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  return area;
}

}  // namespace

TEST_CASE("transform multiplies the rows of the view with the offset from the eye", "[clip]") {
  raster::Face face = tests::frontFace(64);
  face.eye = {1, 2, 3};
  face.x = {0, 0, 1};
  face.y = {2, 0, 0};
  face.w = {0, 1, 0};
  const ViewVertex vertex = raster::transform(face, {11, 22, 33}, {0.25f, 0.75f});
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
      for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k)
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
