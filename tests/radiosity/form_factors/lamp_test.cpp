// Lamps that are points: their direct light against closed forms and rays, and the account of their flux.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/projection/parallel_view.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/symmetry.h"
#include "radiosity/solver/progressive_solver.h"
#include "tests/support/hand_scenes.h"
#include "tests/truth/baked_radiosity.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

using std::numbers::pi;

/// The solid angle of a rectangle in a plane at a distance, with coordinates from the foot of the perpendicular.
double solidAngle(const glm::dvec2& low, const glm::dvec2& high, double distance) {
  const auto term = [&](double x, double y) {
    return std::atan(x * y / (distance * std::sqrt(x * x + y * y + distance * distance)));
  };
  return term(high.x, high.y) - term(low.x, high.y) - term(high.x, low.y) + term(low.x, low.y);
}

/// That of the part that lies in another rectangle.
double solidAngleIn(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& ofLow, const glm::dvec2& ofHigh,
                    double distance) {
  const glm::dvec2 a = glm::max(low, ofLow), b = glm::min(high, ofHigh);
  return a.x < b.x && a.y < b.y ? solidAngle(a, b, distance) : 0;
}

/// A spot downwards, with the angles of its cone.
LampCone down(double inner, double outer) { return {{0, 0, -1}, std::cos(inner), std::cos(outer)}; }

Scene sceneWith(std::vector<Surface> surfaces, const Lamp& lamp) {
  Scene scene = tests::sceneOf(std::move(surfaces));
  scene.lamps = {lamp};
  return scene;
}

/// The elements of a scene and the flux of its lamps.
struct Lit {
  Scene scene;
  Discretization discretization;
  OutsideFlux flux;

  Lit(Scene of, int texels, int resolution = 512)
      : scene(std::move(of)),
        discretization(discretize(scene, {.texels = texels})),
        flux(
            SceneFormFactors(scene, discretization, layOut(discretization), {.resolution = resolution}).outsideFlux()) {
  }

  double received(std::size_t element) const { return flux.received[element][0]; }
  double ofSurface(std::size_t surface) const {
    double sum = 0;
    for (const std::uint32_t e : elementsOf(discretization.grids[surface])) sum += received(e);
    return sum;
  }
  double all() const {
    double sum = 0;
    for (std::size_t e = 0; e < flux.received.size(); ++e) sum += received(e);
    return sum;
  }
};

/// A floor of `size` x `size` around the origin, and what a lamp over the origin gives to its elements:
/// `expected(low, high)`.
double largestError(const Lit& lit, double size, int texels,
                    const std::function<double(const glm::dvec2&, const glm::dvec2&)>& expected) {
  double largest = 0, most = 0;
  for (int row = 0; row < texels; ++row)
    for (int column = 0; column < texels; ++column) {
      const glm::dvec2 low = size * (glm::dvec2(column, row) / double(texels) - 0.5),
                       high = size * (glm::dvec2(column + 1, row + 1) / double(texels) - 0.5);
      const double truth = expected(low, high);
      most = std::max(most, truth);
      largest = std::max(largest, std::abs(lit.received(static_cast<std::size_t>(row * texels + column)) - truth));
    }
  return largest / most;
}

Surface floorOf(double size) {
  return tests::parallelogram("floor", {-size / 2, -size / 2, 0}, {size, 0, 0}, {0, size, 0});
}

/// The share of all directions in which rays from a lamp meet the front of each surface; backs are last but one, and
/// nothing is last.
std::vector<double> sharesByRays(const Scene& scene, const glm::dvec3& from, int count) {
  const RayTree rays(scene);
  std::vector<double> shares(scene.surfaces.size() + 2);
  for (const glm::dvec3& direction : sphereDirections(count)) {
    const auto hit = rays.firstHit(from, direction);
    const std::size_t place = !hit ? shares.size() - 1 : hit->isFront ? hit->surface : shares.size() - 2;
    shares[place] += 1.0 / count;
  }
  return shares;
}

}  // namespace

TEST_CASE("lampProjection divides all flux of a lamp among pixels by their solid angles", "[lamp]") {
  for (const int resolution : {2, 10, 64}) {
    const Projection all = lampProjection(resolution, std::nullopt);
    REQUIRE(all.faces.size() == 6);
    CHECK(all.captured <= wholeShare);
    CHECK(wholeShare - all.captured < 4 * (wholeShare >> 40));
    const double side = 2.0 / resolution;
    for (std::size_t face = 0; face < 6; ++face)
      for (const auto& [column, row] : {std::pair{0, 0}, {resolution / 2, 0}, {resolution - 1, resolution / 2}}) {
        const glm::dvec2 low = side * glm::dvec2(column, row) - 1.0;
        CHECK(formFactor(shareOf(all, face, column, row)) ==
              Approx(solidAngle(low, low + side, 1) / (4 * pi)).epsilon(1e-9));
      }
  }
}

TEST_CASE("lampProjection gives a spot one face where it holds the cone", "[lamp]") {
  const double outer = 0.7;
  const LampCone cone{{0, 0, 1}, std::cos(0.3), std::cos(outer)};
  const Projection plane = lampProjection(200, cone, std::tan(outer)), cube = lampProjection(200, cone);
  CHECK(plane.faces.size() == 1);
  CHECK(cube.faces.size() == 6);
  CHECK(wholeShare - plane.captured < 4 * (wholeShare >> 40));
  // A pixel inside the inner angle, and one outside of the cone.
  const double width = 2 * std::tan(outer) / 200;
  CHECK(formFactor(shareOf(plane, 0, 100, 100)) * fullSolidAngle(cone) ==
        Approx(solidAngle({0, 0}, {width, width}, 1)).epsilon(1e-5));
  CHECK(shareOf(plane, 0, 0, 0) == 0);
  CHECK(fullSolidAngle(cone) ==
        Approx(2 * pi * (1 - std::cos(0.3) + (std::cos(0.3) - std::cos(outer)) / 3)).epsilon(1e-12));
  CHECK(fullSolidAngle(std::nullopt) == Approx(4 * pi));
}

TEST_CASE("outsideFlux of a lamp over a plane follows inverse square and cosine", "[lamp]") {
  constexpr double size = 3, height = 1;
  constexpr int texels = 4;
  const Lit lit(sceneWith({floorOf(size)}, {"lamp", {0, 0, height}, {5, 2, 0}}), texels);
  const double error = largestError(lit, size, texels, [&](const glm::dvec2& low, const glm::dvec2& high) {
    return 5 * solidAngle(low, high, height);
  });
  CAPTURE(error);
  CHECK(error < 1e-4);
  CHECK(lit.flux.received[7][1] == Approx(0.4 * lit.received(7)).epsilon(1e-12));
  CHECK(lit.flux.fromLamps[0] == Approx(20 * pi));
  CHECK(lit.all() + lit.flux.lost[0] == Approx(20 * pi).epsilon(1e-12));
  CHECK(lit.flux.lostToBacks[0] == 0);
  CHECK(sumOf(lit.flux)[0] == Approx(20 * pi).epsilon(1e-12));
}

TEST_CASE("outsideFlux of a lamp below a plane meets its back", "[lamp]") {
  const Lit lit(sceneWith({floorOf(3)}, {"lamp", {0.5, 0, -1}, {1, 1, 1}}), 4, 128);
  CHECK(lit.all() == 0);
  CHECK(lit.flux.lostToBacks[0] == Approx(solidAngle({-2, -1.5}, {1, 1.5}, 1)).epsilon(1e-3));
  CHECK(lit.flux.lost[0] == Approx(4 * pi).epsilon(1e-12));
}

TEST_CASE("outsideFlux of a lamp far away is that of parallel light", "[lamp]") {
  constexpr double size = 2;
  constexpr int texels = 4;
  for (const double height : {4.0, 60.0, 1000.0}) {
    const Lit lit(sceneWith({floorOf(size)}, {"lamp", {0, 0, height}, glm::dvec3(height * height)}), texels);
    const double error = largestError(lit, size, texels, [&](const glm::dvec2& low, const glm::dvec2& high) {
      return height * height * solidAngle(low, high, height);
    });
    CAPTURE(height, error);
    CHECK(error < 1e-3);
    CHECK(lit.all() + lit.flux.lost[0] == Approx(4 * pi * height * height).epsilon(1e-9));
  }
  Scene tooFar = sceneWith({floorOf(size)}, {"far", {0, 0, 3000}, glm::dvec3(1)});
  CHECK_THROWS_WITH(Lit(std::move(tooFar), texels), Catch::Contains("`far`") && Catch::Contains("parallel"));
}

TEST_CASE("outsideFlux of a spot is that of its cone", "[lamp]") {
  constexpr double size = 4, height = 1;
  constexpr int texels = 8;
  const auto [inner, outer] = GENERATE(table<double, double>({{0.3, 0.6}, {0.59, 0.6}, {0, 1.0}, {0.4, 1.5}}));
  const LampCone cone = down(inner, outer);
  const Lit lit(sceneWith({floorOf(size)}, {"spot", {0, 0, height}, glm::dvec3(3), cone}), texels);
  // The integral of intensity times solid angle over an element, by midpoints.
  const double error = largestError(lit, size, texels, [&](const glm::dvec2& low, const glm::dvec2& high) {
    constexpr int steps = 200;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const glm::dvec2 at = glm::mix(low, high, (glm::dvec2(i, j) + 0.5) / double(steps));
        const double distance = std::sqrt(glm::dot(at, at) + height * height), cosine = height / distance;
        const double ramp = std::clamp((cosine - cone.outerCosine) / (cone.innerCosine - cone.outerCosine), 0.0, 1.0);
        sum += 3 * ramp * ramp * cosine / (distance * distance);
      }
    return sum * (high.x - low.x) * (high.y - low.y) / (steps * steps);
  });
  CAPTURE(inner, outer, error);
  CHECK(error < 5e-4);
  CHECK(lit.flux.fromLamps[0] == Approx(3 * fullSolidAngle(cone)));
  if (outer < 1) CHECK(lit.all() == Approx(lit.flux.fromLamps[0]).epsilon(1e-9));
}

TEST_CASE("outsideFlux of a tilted spot that shines past the scene loses the rest", "[lamp]") {
  LampCone cone = down(0.2, 0.5);
  cone.axis = glm::normalize(glm::dvec3(0.4, 0.1, -1));
  Scene near = sceneWith({floorOf(1)}, {"spot", {-0.3, 0, 1}, glm::dvec3(1), cone}), far = near;
  far.lamps[0].position = -8.0 * cone.axis;  // drawn in a view of the scene, which is narrower than the cone
  for (const Scene& scene : {near, far}) {
    const Lit lit(scene, 2);
    CHECK(lit.all() > 0);
    CHECK(lit.flux.lost[0] > 0);
    CHECK(lit.all() + lit.flux.lost[0] == Approx(fullSolidAngle(cone)).epsilon(1e-9));
  }
  // All of the floor is inside the inner angle.
  const Lit lit(far, 2);
  double truth = 0;
  constexpr int steps = 400;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const glm::dvec3 way = glm::dvec3((glm::dvec2(i, j) + 0.5) / double(steps) - 0.5, 0) - far.lamps[0].position;
      truth += -way.z / std::pow(glm::length(way), 3) / (steps * steps);
    }
  CHECK(lit.all() == Approx(truth).epsilon(2e-4));
}

TEST_CASE("outsideFlux of a lamp leaves the shadow of a plate dark", "[lamp]") {
  constexpr double size = 4, height = 2;
  constexpr int texels = 16;
  const glm::dvec2 low(-0.35, -0.2), high(0.55, 0.4);  // of the plate, at a height of 1: its shadow is twice as large
  const Lit lit(sceneWith({floorOf(size),
                           tests::parallelogram("plate", {low, 1}, {high.x - low.x, 0, 0}, {0, high.y - low.y, 0})},
                          {"lamp", {0, 0, height}, glm::dvec3(1)}),
                texels);
  const double error = largestError(lit, size, texels, [&](const glm::dvec2& a, const glm::dvec2& b) {
    return solidAngle(a, b, height) - solidAngleIn(a, b, 2.0 * low, 2.0 * high, height);
  });
  CAPTURE(error);
  CHECK(error < 2e-3);
  CHECK(lit.ofSurface(1) == Approx(solidAngle(low, high, 1)).epsilon(2e-4));
}

TEST_CASE("outsideFlux of a lamp in the middle of a closed cube gives each wall a sixth", "[lamp]") {
  Scene cube = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  cube.lamps = {{"lamp", {0.5, 0.5, 0.5}, {1, 2, 3}}};
  const Lit lit(cube, 4, 256);
  for (std::size_t wall = 0; wall < 6; ++wall) CHECK(lit.ofSurface(wall) == Approx(4 * pi / 6).epsilon(2e-4));
  CHECK(lit.flux.lost[0] < 1e-10);
  CHECK(lit.flux.lostToBacks[0] == 0);

  // Reflections of the closed cube: all flux over 1 - 0.5, by absorption of one half.
  Discretization discretization = lit.discretization;
  SceneFormFactors drawn(lit.scene, discretization, layOut(discretization), {.resolution = 128});
  const Solution solution = solve({.scene = lit.scene,
                                   .discretization = discretization,
                                   .patches = discretization.patches,
                                   .rowOf = drawn.rowOf(),
                                   .split = drawn.splits(),
                                   .settings = {.residual = 1e-5},
                                   .outside = drawn.outsideFlux()});
  double reflected = 0;
  for (std::size_t e = 0; e < discretization.elements.size(); ++e)
    reflected += solution.radiosity[e].y * discretization.elements[e].area;
  CHECK(reflected == Approx(8 * pi).epsilon(1e-4));
  const Energy& energy = solution.energy;
  for (std::size_t band = 0; band < 3; ++band) {
    CHECK(energy.emitted[band] == Approx(4 * pi * double(band + 1)).epsilon(1e-12));
    CHECK(energy.absorbed[band] + energy.unshot[band] + energy.lost[band] ==
          Approx(energy.emitted[band]).epsilon(1e-12));
  }
  CHECK(solution.residual <= 1e-5);
}

TEST_CASE("outsideFlux of a lamp agrees with rays in a furnished room", "[lamp]") {
  Scene room = tests::furnishedRoom();
  const glm::dvec3 at = GENERATE(glm::dvec3(2.9, 1.1, 1.9), glm::dvec3(0.4, 2.2, 0.6), glm::dvec3(1.5, 1.5, 0.4));
  room.lamps = {{"lamp", at, glm::dvec3(1 / (4 * pi))}};
  const Lit lit(room, 8, 256);
  const std::vector<double> truth = sharesByRays(room, at, 400000);
  CAPTURE(at.x);
  for (std::size_t s = 0; s < room.surfaces.size(); ++s) CHECK(lit.ofSurface(s) == Approx(truth[s]).margin(3e-4));
  CHECK(lit.flux.lostToBacks[0] == Approx(truth[room.surfaces.size()]).margin(3e-4));
  CHECK(lit.flux.lost[0] - lit.flux.lostToBacks[0] == Approx(truth.back()).margin(3e-4));
}

TEST_CASE("outsideFlux of a lamp on a mirror plane is a part of that of the whole", "[lamp]") {
  const auto half = [](double x) {
    std::vector<Surface> surfaces{tests::parallelogram("floor", {0, -1, 0}, {2, 0, 0}, {0, 2, 0})};
    Scene scene = sceneWith(std::move(surfaces), {"lamp", {x, 0.2, 0.7}, glm::dvec3(1)});
    setSymmetry(scene, {.mirrors = {{{0.0}, {}, {}}}});
    return scene;
  };
  for (const double x : {0.0, 0.6}) {
    const Lit lit(half(x), 4);
    const double truth = (x == 0 ? 1 : 2) * solidAngle({-2 - x, -1.2}, {2 - x, 0.8}, 0.7) / 2;
    CAPTURE(x);
    CHECK(lit.all() == Approx(truth).epsilon(5e-4));
    CHECK(lit.flux.fromLamps[0] == Approx(x == 0 ? 2 * pi : 4 * pi));
  }
}

TEST_CASE("solve agrees with light tracing in a furnished room with a lamp and a spot", "[lamp]") {
  Scene room = tests::furnishedRoom();
  room.materials[0].reflectance = {0.7, 0.5, 0.3};
  room.lamps = {{"lamp", {2.9, 1.1, 1.2}, {3, 2, 1}},
                {"spot", {0.5, 2.0, 1.8}, {4, 4, 8}, LampCone{glm::normalize(glm::dvec3(0.2, -0.3, -1)), 0.9, 0.7}}};
  Discretization discretization = discretize(room, {.texels = 12});
  SceneFormFactors drawn(room, discretization, layOut(discretization), {.resolution = 128});
  const Solution solution = solve({.scene = room,
                                   .discretization = discretization,
                                   .patches = discretization.patches,
                                   .rowOf = drawn.rowOf(),
                                   .split = drawn.splits(),
                                   .outside = drawn.outsideFlux()});
  const tests::BakedRadiosity truth = tests::bakedRadiosity(room, discretization, {.paths = 1 << 19, .points = 32});
  double all = 0, difference = 0;
  for (std::size_t s = 0; s < room.surfaces.size(); ++s) {
    double flux = 0;
    for (const std::uint32_t e : elementsOf(discretization.grids[s]))
      flux += discretization.elements[e].area * bandSum(solution.radiosity[e]);
    const double traced = bandSum(truth.surfaces[s].flux);
    CAPTURE(room.surfaces[s].name, flux, traced);
    CHECK(std::abs(flux - traced) <= 0.02 * traced + 4 * bandSum(truth.surfaces[s].fluxError));
    all += traced;
    difference += std::abs(flux - traced);
  }
  CAPTURE(difference / all);
  CHECK(difference < 0.006 * all);
}
