// triangleSlices compared with a search through all pairs, segment by segment.
#include "radiosity/discretization/triangle_slices.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "radiosity/projection/patch_view.h"
#include "raster/base/parallel.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Random triangles in a cube, each a surface of its own.
Scene randomTriangles(unsigned seed, int count) {
  std::mt19937 random(seed);
  const auto draw = [&] { return double(random()) / 4294967296.0; };
  const auto point = [&] {
    const double x = draw(), y = draw(), z = draw();
    return glm::dvec3(x, y, z);
  };
  std::vector<Surface> surfaces;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 a = point(), b = a + 0.6 * (point() - 0.5), c = a + 0.6 * (point() - 0.5);
    surfaces.push_back(
        tests::surfaceOf("t" + std::to_string(i), {tests::triangleOf({a, {0, 0}}, {b, {1, 0}}, {c, {0, 1}})}));
  }
  return tests::sceneOf(std::move(surfaces));
}

glm::dvec3 pointAt(const Triangle& triangle, const glm::dvec2& weights) {
  const auto& [a, b, c] = triangle.position;
  return a + weights.x * (b - a) + weights.y * (c - a);
}

double heightOver(const Triangle& triangle, const glm::dvec3& point) {
  return std::abs(glm::dot(normal(triangle), point - triangle.position[0]));
}

/// The distance of a point from a triangle, in its plane.
double distanceInPlane(const Triangle& triangle, const glm::dvec3& point) {
  const glm::dvec3 n = normal(triangle);
  double distance = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& a = triangle.position[k];
    const glm::dvec3 inwards = glm::normalize(glm::cross(n, triangle.position[(k + 1) % 3] - a));
    distance = std::max(distance, -glm::dot(inwards, point - a));
  }
  return distance;
}

/// The length of the intersection of two triangles, the first one lifted: the common range of both along the
/// intersection of their planes.
double commonLength(const Scene& scene, const Triangle& one, const Triangle& other) {
  const glm::dvec3 n = normal(one), m = normal(other), along = glm::normalize(glm::cross(n, m));
  const double lift = eyeHeight * scene.extent;
  const auto range = [&](const Triangle& triangle, const glm::dvec3& shift, const glm::dvec3& planeNormal,
                         const glm::dvec3& planePoint) {
    double low = 1e9, high = -1e9;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 a = triangle.position[k] + shift, b = triangle.position[(k + 1) % 3] + shift;
      const double da = glm::dot(planeNormal, a - planePoint), db = glm::dot(planeNormal, b - planePoint);
      if ((da > 0) == (db > 0)) continue;
      const double place = glm::dot(along, a + da / (da - db) * (b - a));
      low = std::min(low, place);
      high = std::max(high, place);
    }
    return std::pair(low, high);
  };
  const auto ofOne = range(one, lift * n, m, other.position[0]);
  const auto ofOther = range(other, glm::dvec3(0), n, one.position[0] + lift * n);
  return std::min(ofOne.second, ofOther.second) - std::max(ofOne.first, ofOther.first);
}

double lengthOf(const Triangle& triangle, const Slice& slice) {
  const auto& [a, b, c] = triangle.position;
  const glm::dvec2 step = slice.to - slice.from;
  return glm::length(step.x * (b - a) + step.y * (c - a));
}

bool areSame(const std::vector<std::vector<Slice>>& a, const std::vector<std::vector<Slice>>& b) {
  const auto isSame = [](const Slice& x, const Slice& y) { return x.from == y.from && x.to == y.to; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), isSame);
  });
}

}  // namespace

TEST_CASE("triangleSlices finds the slices that a search through all pairs finds", "[slices]") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Scene scene = randomTriangles(seed, 150);
    const double tolerance = eyeInset * scene.extent;
    const std::vector<std::vector<Slice>> slices = triangleSlices(scene, RayTree(scene)).ofTriangle;
    std::size_t found = 0;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
      const Triangle& one = scene.surfaces[i].triangles[0];
      // Near the tolerances either answer is right.
      std::size_t explained = 0;
      for (std::size_t j = 0; j < scene.surfaces.size(); ++j) {
        const Triangle& other = scene.surfaces[j].triangles[0];
        if (i == j) continue;
        const double expected = commonLength(scene, one, other);
        // A slice was moved along the other triangle by a lift over the sine of the angle between both. So it may leave
        // the triangle by that much. If the sine is below 1/256, it stays a lift above.
        const double lift = eyeHeight * scene.extent;
        const auto liesOnOther = [&](const Slice& slice) {
          for (const glm::dvec2& end : {slice.from, slice.to}) {
            const glm::dvec3 point = pointAt(one, end);
            if (heightOver(other, point) > 1.01 * lift || distanceInPlane(other, point) > 257 * lift) return false;
          }
          return true;
        };
        const auto next = std::find_if(slices[i].begin(), slices[i].end(), liesOnOther);
        const bool isFound = next != slices[i].end();
        INFO("seed " << seed << ", triangle " << i << " by " << j << ", length " << expected);
        if (expected > 100 * tolerance) REQUIRE(isFound);
        if (expected < -100 * tolerance) REQUIRE_FALSE(isFound);
        if (!isFound) continue;
        CHECK(lengthOf(one, *next) == Approx(expected).epsilon(0).margin(100 * tolerance));
        for (const glm::dvec2& end : {next->from, next->to})
          CHECK(distanceInPlane(one, pointAt(one, end)) < 2 * tolerance);
        ++explained;
        ++found;
      }
      CHECK(explained == slices[i].size());
    }
    CHECK(found > 100);
  }
}

TEST_CASE("triangleSlices of a floor under a box are the box's outline", "[slices]") {
  std::vector<Surface> surfaces = tests::box("room", {0, 0, 0}, {4, 3, 2}, true);
  const std::vector<Surface> box = tests::box("box", {1, 0.25, 0}, {1, 0.5, 0.5}, false);
  surfaces.insert(surfaces.end(), box.begin(), box.end());
  const Scene scene = tests::sceneOf(surfaces);
  const std::vector<std::vector<Slice>> slices = triangleSlices(scene, RayTree(scene)).ofTriangle;
  double length = 0;
  for (std::size_t t = 0; t < slices.size(); ++t)
    for (const Slice& slice : slices[t]) {
      // Walls touch the floor along its border, and so do the sides of the box.
      CHECK(t < 2);
      length += lengthOf(scene.surfaces[0].triangles[t], slice);
    }
  CHECK(length == Approx(3).epsilon(1e-4));
}

TEST_CASE("triangleSlices leaves out hovering objects, and faces in the triangle's plane", "[slices]") {
  const auto count = [](const std::vector<Surface>& surfaces) {
    const Scene scene = tests::sceneOf(surfaces);
    std::size_t sum = 0;
    for (const std::vector<Slice>& some : triangleSlices(scene, RayTree(scene)).ofTriangle) sum += some.size();
    return sum;
  };
  const Surface floor = tests::parallelogram("floor", {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  CHECK(count({floor}) == 0);
  CHECK(count({floor, tests::parallelogram("rug", {1, 1, 0}, {1, 0, 0}, {0, 1, 0})}) == 0);
  CHECK(count({floor, tests::parallelogram("wall", {1, 1, 0.001}, {1, 0, 0}, {0, 0, 1})}) == 0);
  CHECK(count({floor, tests::parallelogram("wall", {0, 0, 0}, {4, 0, 0}, {0, 0, 1})}) == 0);
  CHECK(count({floor, tests::parallelogram("wall", {1, 1, 0}, {1, 0, 0}, {0, 0, 1})}) > 0);
}

TEST_CASE("triangleSlices leaves out slices of a surface by its own folds, and keeps others along inner edges",
          "[slices]") {
  // A valley whose flanks slice each other along the common edge.
  Surface valley = tests::surfaceOf("valley", {});
  const glm::dvec3 a(0, 0, 0), b(0, 1, 0);
  valley.triangles = {tests::triangleOf({a, {0, 0}}, {{1, 0, 1}, {1, 0}}, {b, {0, 1}}),
                      tests::triangleOf({{-1, 0, 1}, {1, 1}}, {a, {0, 0}}, {b, {0, 1}})};
  const auto isCut = [](const Scene& scene) {
    const auto slices = triangleSlices(scene, RayTree(scene)).ofTriangle;
    return std::array{!slices[0].empty(), !slices[1].empty()};
  };
  CHECK(isCut(tests::sceneOf({valley})) == std::array{false, false});
  const Surface fin = tests::parallelogram("fin", {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  CHECK(isCut(tests::sceneOf({valley, fin})) == std::array{true, true});
}

TEST_CASE("triangleSlices gives the same bits for any number of threads, and when repeated", "[slices]") {
  const Scene scene = randomTriangles(5, 200);
  const std::vector<std::vector<Slice>> slices = triangleSlices(scene, RayTree(scene)).ofTriangle;
  for (const int threads : {1, 2, 5}) {
    const raster::ThreadLimit limit(threads);
    CHECK(areSame(triangleSlices(scene, RayTree(scene)).ofTriangle, slices));
  }
}
