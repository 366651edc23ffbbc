// RayCaster: the nearest triangle of a search through all, no gaps between neighbours, and the epsilon rule.
#include "reference/truth/rays/ray_caster.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "radiosity/scene/load_scene.h"
#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/surface_pieces.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::reference;
using namespace hemitex::radiosity;

namespace {

/// Scenes of single triangles; their charts are not used.
Scene triangles(const std::vector<std::array<glm::dvec3, 3>>& corners) {
  std::vector<Triangle> list;
  for (const auto& corner : corners) list.push_back({corner, {}, {}});
  return tests::sceneOf({tests::surfaceOf("triangles", std::move(list))});
}

/// A triangle that makes the frame of the scene equal to that of the file, together with its opposite.
const std::array<glm::dvec3, 3> frameCorner{glm::dvec3(0.5, 0, 0), {0.5, 1e-3, 0}, {0.5, 0, 1e-3}};
const std::array<glm::dvec3, 3> oppositeCorner{glm::dvec3(-0.5, 0, 0), {-0.5, -1e-3, 0}, {-0.5, 0, -1e-3}};

struct Random {
  std::mt19937 bits{5};
  double uniform(double low, double high) { return low + (high - low) * double(bits()) / 4294967296.0; }
  glm::dvec3 point(double low, double high) { return {uniform(low, high), uniform(low, high), uniform(low, high)}; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 p = point(-1, 1);
      if (glm::dot(p, p) <= 1 && glm::dot(p, p) > 1e-3) return glm::normalize(p);
    }
  }
};

/// Cramer's rule for start + t direction = a + u (b - a) + v (c - a).
std::optional<glm::dvec3> solve(const std::array<glm::dvec3, 3>& corner, const glm::dvec3& start,
                                const glm::dvec3& direction) {
  const glm::dmat3 matrix(-direction, corner[1] - corner[0], corner[2] - corner[0]);
  const glm::dvec3 tuv = glm::inverse(matrix) * (start - corner[0]);
  if (!(tuv.x > 0 && tuv.y >= 0 && tuv.z >= 0 && tuv.y + tuv.z <= 1)) return std::nullopt;
  return tuv;
}

/// Two triangles in the plane z = 0 over the unit square, facing up, and surfaces above them.
Scene floorWith(std::vector<Surface> surfaces) {
  surfaces.insert(surfaces.begin(), tests::parallelogram("floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  return tests::sceneOf(std::move(surfaces));
}

Scene moved(Scene scene, const glm::dvec3& by) {
  for (Surface& surface : scene.surfaces)
    for (Triangle& triangle : surface.triangles)
      for (glm::dvec3& corner : triangle.position) corner += by;
  return tests::finish(std::move(scene));
}

}  // namespace

TEST_CASE("RayCaster::firstHit finds the nearest triangle of a search through all", "[rays]") {
  Random random;
  std::vector<std::array<glm::dvec3, 3>> soup;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 place = random.point(-1, 1);
    const double size = random.uniform(0.001, 0.5);
    soup.push_back({place, place + size * random.direction(), place + size * random.direction()});
  }
  const Scene scene = triangles(soup);
  const RayCaster rays(scene);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t from = static_cast<std::uint32_t>(i) % 300;
    const Ray ray{inFrame(scene, (soup[from][0] + soup[from][1] + soup[from][2]) / 3.0), random.direction(), from};
    double nearest = std::numeric_limits<double>::infinity();
    RayHit expected;
    for (std::uint32_t t = 0; t < soup.size(); ++t) {
      const auto corner = inFrame(scene, scene.surfaces[0].triangles[t]);
      const auto found = solve(corner, ray.start, ray.direction);
      if (t == from || !found || found->x >= nearest) continue;
      nearest = found->x;
      const bool front = glm::dot(ray.direction, glm::cross(corner[1] - corner[0], corner[2] - corner[0])) < 0;
      expected = {t, {found->y, found->z}, front};
    }
    const std::optional<RayHit> hit = rays.firstHit(ray);
    REQUIRE(hit.has_value() == (nearest < 10));
    if (!hit) continue;
    ++met;
    CHECK(hit->triangle == expected.triangle);
    CHECK(hit->front == expected.front);
    CHECK(glm::length(hit->weights - expected.weights) < 1e-9);
  }
  CHECK(met > 5000);
}

TEST_CASE("RayCaster::firstHit lets no ray pass between triangles that share an edge", "[rays]") {
  // A closed box of many triangles, rotated so that nothing is axis-parallel; rays aim at points of the edges and at
  // the corners.
  std::vector<std::array<glm::dvec3, 3>> shell;
  Random random;
  const glm::dvec3 x = random.direction(), y = glm::normalize(glm::cross(x, random.direction())), z = glm::cross(x, y);
  const auto place = [&](const glm::dvec3& p) { return p.x * x + p.y * y + p.z * z; };
  const int side = 6;
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {-0.5, 0.5})
      for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
          const auto at = [&](int column, int row) {
            glm::dvec3 p(0);
            p[axis] = end;
            p[(axis + 1) % 3] = double(column) / side - 0.5;
            p[(axis + 2) % 3] = double(row) / side - 0.5;
            return place(p);
          };
          shell.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
          shell.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
  const Scene scene = triangles(shell);
  const RayCaster rays(scene);
  int slipped = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto corner = inFrame(scene, scene.surfaces[0].triangles[random.bits() % shell.size()]);
    const double t = i % 4 == 0 ? 0 : random.uniform(0, 1);
    const glm::dvec3 start = random.point(-0.2, 0.2), end = corner[0] + t * (corner[1 + random.bits() % 2] - corner[0]);
    slipped += !rays.firstHit({start, glm::normalize(end - start), 0xffffffff});
  }
  CHECK(slipped == 0);
}

TEST_CASE("RayCaster::firstHit rounds distances to epsilon, and meets nothing at distance 0", "[rays]") {
  // The frame of this scene is the file's: its bounds run from -0.5 to 0.5 along x and are thin.
  const auto gap = [](double distance) {
    Scene scene = triangles({frameCorner,
                             oppositeCorner,
                             {glm::dvec3(0, -1e-3, distance), {-1e-3, 1e-3, distance}, {1e-3, 1e-3, distance}}});
    scene.origin = glm::dvec3(0);
    scene.extent = 1;
    return RayCaster(scene).firstHit({{0, 0, 0}, {0, 0, 1}, 0}).has_value();
  };
  CHECK(gap(rayEpsilon));
  CHECK(gap(0.51 * rayEpsilon));
  CHECK_FALSE(gap(0.49 * rayEpsilon));
  CHECK_FALSE(gap(0));
  CHECK_FALSE(gap(-rayEpsilon));
}

TEST_CASE("RayCaster::firstHit of coincident surfaces finds the first in the scene's order", "[rays]") {
  // The same tilted square twice, with corners in any order and both windings, so that distances differ by rounding.
  Random random;
  for (int turn = 0; turn < 100; ++turn) {
    const glm::dvec3 place = random.point(-1, 1), u = random.direction(),
                     v = 0.7 * glm::normalize(glm::cross(u, random.direction()));
    const std::array<glm::dvec3, 4> corner{place, place + u, place + u + v, place + v};
    const auto turned = [&](std::size_t first, std::size_t step) {
      return tests::quad("square", {corner[first % 4], corner[(first + step) % 4], corner[(first + 2 * step) % 4],
                                    corner[(first + 3 * step) % 4]});
    };
    const std::uint32_t first = random.bits() % 4, second = random.bits() % 4;
    const Scene scene = tests::sceneOf({turned(first, 1), turned(second, turn % 2 == 0 ? 1 : 3)});
    const RayCaster rays(scene);
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 target = inFrame(scene, place + random.uniform(0.1, 0.9) * u + random.uniform(0.1, 0.9) * v);
      const glm::dvec3 direction = random.direction();
      if (std::abs(glm::dot(direction, glm::normalize(glm::cross(u, v)))) < 0.1) continue;
      const auto hit = rays.firstHit({target - 0.3 * direction, direction, 0xffffffff});
      REQUIRE(hit);
      CHECK(hit->triangle < 2);
    }
  }
}

TEST_CASE("RayCaster::firstHit of touching surfaces has no leaks and no self-intersections", "[rays]") {
  // Starts on the floor of a closed room, as near as 1e-12 to the walls and to its own diagonal: every ray meets the
  // inside of a wall. A second piece of floor beside it with nothing above: every ray leaves.
  const Scene room = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const Scene open = floorWith({tests::parallelogram("beside", {1, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                tests::parallelogram("below", {0.5, 0, 0}, {0, 0, -1}, {0, 1, 0})});
  for (const double distance : {0.0, 1e3, 1e6}) {
    INFO("moved by " << distance);
    const Scene closedScene = moved(room, {distance, -distance, distance / 3});
    const Scene openScene = moved(open, {distance, -distance, distance / 3});
    const RayCaster closedRays(closedScene), openRays(openScene);
    Random random;
    int wrong = 0, selfHits = 0;
    for (int i = 0; i < 40000; ++i) {
      const double t = random.uniform(0, 1), near = std::pow(10.0, random.uniform(-11, -1));
      const glm::dvec3 direction = random.direction();
      const auto from = [&](const Scene& scene, const glm::dvec3& weights, std::uint32_t surface, std::uint32_t number,
                            const glm::dvec3& normal) {
        const auto corner = inFrame(scene, scene.surfaces[surface].triangles[number % 2]);
        const double side = glm::dot(direction, normal) > 0 ? 1 : -1;
        return Ray{weights.x * corner[0] + weights.y * corner[1] + weights.z * corner[2], side * direction, number};
      };
      // Near to one of the three edges of one of the two triangles.
      glm::dvec3 weights((1 - near) * t, (1 - near) * (1 - t), near);
      for (int k = 0; k < i % 3; ++k) weights = {weights.z, weights.x, weights.y};
      const std::uint32_t half = random.bits() % 2;
      const auto hit = closedRays.firstHit(from(closedScene, weights, 2, 4 + half, {0, 1, 0}));
      wrong += !hit || !hit->front || hit->triangle / 2 == 2;
      selfHits += openRays.firstHit(from(openScene, weights, 0, half, {0, 0, 1})).has_value();
    }
    CHECK(wrong == 0);
    CHECK(selfHits == 0);
  }
}

TEST_CASE("RayCaster::firstHit in two-sided scenes passes backs and meets their twins", "[rays]") {
  Scene scene = tests::sceneOf({tests::parallelogram("front", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}),
                                tests::parallelogram("back", {0, 0, 1}, {0, 1, 0}, {1, 0, 0}),
                                tests::parallelogram("floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  const Ray up{inFrame(scene, {0.4, 0.3, 0}), {0, 0, 1}, 4};
  const auto oneSided = RayCaster(scene).firstHit(up);
  REQUIRE(oneSided);
  CHECK(oneSided->triangle / 2 == 0);
  CHECK_FALSE(oneSided->front);
  makeTwins(scene.surfaces, 0, 1);
  const auto twoSided = RayCaster(scene).firstHit(up);
  REQUIRE(twoSided);
  CHECK(twoSided->triangle / 2 == 1);
  CHECK(twoSided->front);
}

TEST_CASE("RayCaster::firstHit equals nearestHit, which asks every triangle, on the Cornell box", "[rays]") {
  const Scene scene = loadScene(HEMITEX_DATA "/cornell-box.obj");
  const std::vector<Target> targets = targetsOf(scene);
  const RayCaster rays(scene);
  Random random;
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    // From a random point of a triangle: half of the rays in any direction, the others to a corner, where triangles
    // meet.
    const auto from = static_cast<std::uint32_t>(random.bits() % targets.size());
    const std::array<glm::dvec3, 3>& corner = targets[from].corner;
    const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
    const glm::dvec3 start = corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
    const glm::dvec3 end = targets[random.bits() % targets.size()].corner[random.bits() % 3];
    const Ray ray{start, i % 2 == 0 ? random.direction() : glm::normalize(end - start), from};
    const std::optional<RayHit> hit = rays.firstHit(ray), nearest = nearestHit(targets, ray);
    REQUIRE(hit.has_value() == nearest.has_value());
    if (!hit) continue;
    ++met;
    CHECK(hit->triangle == nearest->triangle);
    CHECK(hit->weights == nearest->weights);
    CHECK(hit->front == nearest->front);
  }
  CHECK(met > 10000);
}

TEST_CASE("RayCaster leaves the floating-point mode of all threads unchanged", "[rays]") {
  // Embree flushes subnormal numbers to 0; no thread of the program may keep that mode.
  const Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const RayCaster rays(scene);
  std::atomic<int> flushed = 0;
  raster::parallelFor(1000, [&](std::size_t) {
    rays.firstHit({{0, 0, 0}, {0, 1, 0}, 0xffffffff});
    volatile double smallest = std::numeric_limits<double>::min();
    flushed += smallest / 2 == 0;
  });
  CHECK(flushed == 0);
}
