// RayTree against a search of all triangles, and rays that graze, touch or lie in triangles.
#include "radiosity/scene/ray_tree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 randomPoint(std::mt19937& random, double size) {
  const auto coordinate = [&] { return size * (static_cast<double>(random()) / 0x1p31 - 1); };
  return {coordinate(), coordinate(), coordinate()};
}

/// Surfaces of 1 to 9 triangles in the cube [-1, 1]^3, of any orientation.
Scene randomScene(std::mt19937& random, int surfaces) {
  std::vector<Surface> all;
  for (int s = 0; s < surfaces; ++s) {
    std::vector<Triangle> triangles(1 + random() % 9);
    for (Triangle& triangle : triangles) {
      const glm::dvec3 middle = randomPoint(random, 0.8);
      for (glm::dvec3& corner : triangle.position) corner = middle + randomPoint(random, 0.2);
    }
    all.push_back(tests::surfaceOf("s" + std::to_string(s), std::move(triangles)));
  }
  return tests::sceneOf(std::move(all));
}

/// All triangles that a ray meets, nearest first. The weights are ratios of volumes of tetrahedra, which RayTree does
/// not compute.
std::vector<TriangleHit> allHits(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction) {
  std::vector<TriangleHit> hits;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    for (std::uint32_t t = 0; t < scene.surfaces[s].triangles.size(); ++t) {
      const auto& position = scene.surfaces[s].triangles[t].position;
      const glm::dvec3 a = position[0] - origin, b = position[1] - origin, c = position[2] - origin;
      const double ofA = glm::dot(direction, glm::cross(b, c)), ofB = glm::dot(direction, glm::cross(c, a)),
                   ofC = glm::dot(direction, glm::cross(a, b)), sum = ofA + ofB + ofC;
      if (sum == 0 || std::min({ofA / sum, ofB / sum, ofC / sum}) < 0) continue;
      const double distance = glm::dot(a, glm::cross(b, c)) / sum;
      if (distance > 0) hits.push_back({s, t, {ofB / sum, ofC / sum}, distance, sum < 0});
    }
  std::sort(hits.begin(), hits.end(),
            [](const TriangleHit& a, const TriangleHit& b) { return a.distance < b.distance; });
  return hits;
}

/// The unit triangle (0 0 z), (1 0 z), (0 1 z); its front faces upwards or downwards.
Triangle unitTriangle(double z, bool isUpwards) {
  const glm::dvec3 a(0, 0, z), b(1, 0, z), c(0, 1, z);
  Triangle triangle;
  triangle.position = {a, isUpwards ? b : c, isUpwards ? c : b};
  return triangle;
}

/// One surface per triangle.
Scene sceneOfTriangles(const std::vector<Triangle>& triangles) {
  std::vector<Surface> surfaces;
  for (const Triangle& triangle : triangles) surfaces.push_back(tests::surfaceOf("s", {triangle}));
  return tests::sceneOf(std::move(surfaces));
}

}  // namespace

TEST_CASE("RayTree::firstHit equals a search of all triangles", "[rays]") {
  std::mt19937 random(1);
  int met = 0;
  for (const int surfaces : {1, 2, 10, 100}) {
    const Scene scene = randomScene(random, surfaces);
    const RayTree tree(scene);
    for (int ray = 0; ray < 1000; ++ray) {
      const glm::dvec3 origin = randomPoint(random, 1.5), direction = randomPoint(random, 0.6) - origin;
      const std::vector<TriangleHit> expected = allHits(scene, origin, direction);
      const auto hit = tree.firstHit(origin, direction);
      REQUIRE(hit.has_value() == !expected.empty());
      if (!hit) continue;
      ++met;
      REQUIRE(hit->surface == expected[0].surface);
      REQUIRE(hit->triangle == expected[0].triangle);
      REQUIRE(hit->isFront == expected[0].isFront);
      REQUIRE(hit->distance == Approx(expected[0].distance).epsilon(1e-9));
      REQUIRE(glm::distance(hit->weights, expected[0].weights) < 1e-9);
    }
  }
  CHECK(met > 1000);
}

TEST_CASE("RayTree::firstHit is the first of triangles that coincide, and finds all of many", "[rays]") {
  // The tree cannot separate triangles with the same middle.
  const RayTree tree(sceneOfTriangles(std::vector<Triangle>(1000, unitTriangle(0, true))));
  const auto hit = tree.firstHit({0.2, 0.2, 1}, {0, 0, -1});
  REQUIRE(hit);
  CHECK(hit->surface == 0);
  CHECK(hit->distance == 1);
  std::vector<std::uint32_t> numbers;
  tree.appendNear({0, 0, 0}, {1, 1, 0}, numbers);
  CHECK(numbers.size() == 1000);
}

TEST_CASE("RayTree::meetsBack equals a search of all triangles", "[rays]") {
  std::mt19937 random(2);
  const Scene scene = randomScene(random, 60);
  const RayTree tree(scene);
  int met = 0;
  for (int ray = 0; ray < 4000; ++ray) {
    const glm::dvec3 origin = randomPoint(random, 1), direction = randomPoint(random, 1);
    const double distance = static_cast<double>(random() % 8) / 4, cosine = static_cast<double>(random() % 5) / 4;
    const std::vector<TriangleHit> hits = allHits(scene, origin, direction);
    const bool expected = std::any_of(hits.begin(), hits.end(), [&](const TriangleHit& hit) {
      const glm::dvec3 along = normal(scene.surfaces[hit.surface].triangles[hit.triangle]);
      return hit.distance < distance && !hit.isFront && glm::dot(along, direction) >= cosine * glm::length(direction);
    });
    REQUIRE(tree.meetsBack(origin, direction, distance, cosine) == expected);
    met += expected;
  }
  CHECK(met > 200);
}

TEST_CASE("RayTree::appendNear equals a search of all triangles", "[rays]") {
  std::mt19937 random(3);
  for (const int surfaces : {1, 100}) {
    const Scene scene = randomScene(random, surfaces);
    const RayTree tree(scene);
    for (int box = 0; box < 300; ++box) {
      const glm::dvec3 a = randomPoint(random, 1), b = a + randomPoint(random, 0.5), low = glm::min(a, b),
                       high = glm::max(a, b);
      std::vector<std::uint32_t> expected{77}, numbers{77};
      std::uint32_t number = 0;
      for (const Surface& surface : scene.surfaces)
        for (const Triangle& triangle : surface.triangles) {
          const auto& [p, q, r] = triangle.position;
          const glm::dvec3 from = glm::min(glm::min(p, q), r), to = glm::max(glm::max(p, q), r);
          if (glm::all(glm::lessThanEqual(from, high)) && glm::all(glm::greaterThanEqual(to, low)))
            expected.push_back(number);
          ++number;
        }
      tree.appendNear(low, high, numbers);
      std::sort(numbers.begin() + 1, numbers.end());
      REQUIRE(numbers == expected);
    }
  }
}

TEST_CASE("RayTree::appendNear includes triangles whose boxes touch the box", "[rays]") {
  const RayTree tree(sceneOfTriangles({unitTriangle(0, true), unitTriangle(2, true)}));
  const auto near = [&](const glm::dvec3& low, const glm::dvec3& high) {
    std::vector<std::uint32_t> numbers;
    tree.appendNear(low, high, numbers);
    return numbers;
  };
  CHECK(near({1, 1, 0}, {2, 2, 1}) == std::vector<std::uint32_t>{0});
  CHECK(near({1, 1, 0x1p-40}, {2, 2, 1}).empty());
  CHECK(near({0.5, 0.5, 0}, {0.5, 0.5, 2}).size() == 2);
}

TEST_CASE("RayTree::firstHit and meetsBack treat rays along the axes as any other", "[rays]") {
  // A grid of unit triangles in each of three planes, one per axis; the rays meet the middle of each.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto turned = [&](const glm::dvec3& p) {
      glm::dvec3 result;
      for (std::size_t k = 0; k < 3; ++k) result[static_cast<int>((k + axis) % 3)] = p[static_cast<int>(k)];
      return result;
    };
    std::vector<Triangle> triangles;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) {
        Triangle triangle = unitTriangle(0, true);
        for (glm::dvec3& corner : triangle.position) corner = turned(corner + glm::dvec3(i, j, 0));
        triangles.push_back(triangle);
      }
    const RayTree tree(sceneOfTriangles(triangles));
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) {
        const glm::dvec3 below = turned(glm::dvec3(i + 0.25, j + 0.25, -2)), up = turned({0, 0, 1});
        const auto back = tree.firstHit(below, up), front = tree.firstHit(below + 4.0 * up, -up);
        REQUIRE((back && front));
        CHECK(back->surface == static_cast<std::uint32_t>(5 * i + j));
        CHECK(back->weights == glm::dvec2(0.25));
        CHECK(back->distance == 2);
        CHECK_FALSE(back->isFront);
        CHECK(front->surface == back->surface);
        CHECK(front->isFront);
        CHECK(tree.meetsBack(below, up, 3, 1));
        CHECK_FALSE(tree.meetsBack(below, up, 2, 1));  // the end does not belong to the ray
        CHECK_FALSE(tree.meetsBack(below + 4.0 * up, -up, 3, 1));
      }
    CHECK_FALSE(tree.firstHit(turned({0.75, 0.75, -2}), turned({0, 0, 1})));
    CHECK_FALSE(tree.firstHit(turned({0.25, 0.25, -2}), turned({0, 0, -1})));
    CHECK_FALSE(tree.firstHit(turned({-1, 0.25, 1}), turned({1, 0, 0})));
  }
}

TEST_CASE("RayTree::firstHit meets corners and edges, and no triangle that contains the ray or its origin", "[rays]") {
  const RayTree tree(sceneOfTriangles({unitTriangle(0, true)}));
  for (const glm::dvec2& at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(0.5, 0.5)})
    for (const glm::dvec3& direction : {glm::dvec3(0.25, 0.5, -1), glm::dvec3(-0.5, 0.25, -1), glm::dvec3(0.5, -2, 1)})
      CHECK(tree.firstHit(glm::dvec3(at, 0) - direction, direction)->distance == 1);
  CHECK_FALSE(tree.firstHit({0.5 + 0x1p-40, 0.5, 1}, {0, 0, -1}));
  CHECK_FALSE(tree.firstHit({-1, 0.25, 0}, {1, 0, 0}));    // in its plane
  CHECK_FALSE(tree.firstHit({0.25, 0.25, 0}, {0, 0, 1}));  // starts on it
  CHECK_FALSE(tree.firstHit({0.25, 0.25, 1}, {0, 0, 0}));  // no direction
  CHECK(tree.firstHit({0.25, 0.25, 1}, {0, 0, -0.5})->distance == 2);
}

TEST_CASE("RayTree::firstHit returns the back of two faces that touch", "[rays]") {
  const auto first = [](double backDistance) {
    const Triangle front = unitTriangle(0, true), back = unitTriangle(-backDistance, false);
    // The extent of the scene is that of the third triangle.
    Triangle far = unitTriangle(-1, true);
    far.position[1].x = -100;
    const RayTree tree(sceneOfTriangles({front, back, far}));
    const glm::dvec3 steep(0, 0, -1), flat(0.5, 0, -0.01), middle(0.25, 0.25, 0);
    const std::uint32_t surface = tree.firstHit(middle - steep, steep)->surface;
    CHECK(tree.firstHit(middle - flat, flat)->surface == surface);
    return surface;
  };
  CHECK(first(0) == 1);
  CHECK(first(50 * 0x1p-21) == 1);
  CHECK(first(1000 * 0x1p-21) == 0);
  CHECK(first(-0.005) == 1);
}

TEST_CASE("RayTree meets no triangle without an area, and none in a scene without triangles", "[rays]") {
  Triangle point = unitTriangle(0, true), line = unitTriangle(0, true);
  point.position = {glm::dvec3(0.25, 0.25, 0), glm::dvec3(0.25, 0.25, 0), glm::dvec3(0.25, 0.25, 0)};
  line.position[2] = line.position[1];
  const RayTree flat(sceneOfTriangles({point, line, unitTriangle(-1, true)}));
  CHECK(flat.firstHit({0.25, 0.25, 1}, {0, 0, -1})->surface == 2);
  CHECK(flat.firstHit({0.5, 0, 1}, {0, 0, -1})->surface == 2);

  const RayTree empty{Scene()};
  std::vector<std::uint32_t> numbers;
  empty.appendNear(glm::dvec3(-infinity), glm::dvec3(infinity), numbers);
  CHECK(numbers.empty());
  CHECK_FALSE(empty.firstHit({0, 0, 0}, {0, 0, 1}));
  CHECK_FALSE(empty.meetsBack({0, 0, 0}, {0, 0, 1}, 1, 0));
}
