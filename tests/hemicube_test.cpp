// The hemicube: delta form factors against closed forms, faces that partition the hemisphere, rows that close.
#include "radiosity/hemicube.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/box_scene.h"
#include "tests/hemicube_world.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// The form factor from a point to a parallel rectangle a x b at distance 1 whose corner is on the normal, and to a
/// rectangle that stands on the horizon at distance 1, a high and b wide from the foot of the perpendicular.
double toParallel(double a, double b) {
  const double p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * M_PI);
}
double toPerpendicular(double a, double b) {
  const double s = std::sqrt(a * a + 1);
  return (std::atan(b) - std::atan(b / s) / s) / (2 * M_PI);
}

/// The integral over one pixel: inclusion and exclusion of the rectangles from the axis to its four corners.
template <typename Corner>
double pixel(const Corner& corner, double x0, double x1, double y0, double y1) {
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

using World = tests::HemicubeWorld;

std::uint64_t sum(const FormFactorRow& row) {
  return std::accumulate(row.shares.begin(), row.shares.end(), row.background + row.back);
}

/// The form factor from a row to a surface.
double toSurface(const World& world, const FormFactorRow& row, const std::string& name) {
  double factor = 0;
  for (std::size_t i = 0; i < row.elements.size(); ++i)
    if (world.scene.surfaces[world.discretization.elements[row.elements[i]].surface].name == name)
      factor += formFactor(row.shares[i]);
  return factor;
}

/// The mean of the rows of a surface's patches to another surface; all patches have equal areas here.
double meanFactor(World& world, const std::string& from, const std::string& to, int resolution) {
  HemicubeRows rows = world.rows(resolution);
  double factor = 0;
  int count = 0;
  for (std::uint32_t p = 0; p < world.discretization.patches.size(); ++p)
    if (world.scene.surfaces[world.discretization.patches[p].surface].name == from) {
      factor += toSurface(world, rows.ofPatch(p), to);
      ++count;
    }
  return factor / count;
}

}  // namespace

TEST_CASE("the delta form factors of all five faces sum to exactly one", "[hemicube]") {
  for (const int resolution : {2, 4, 6, 10, 30, 32, 64, 100, 128, 254, 256, 512, 1024}) {
    const DeltaFormFactors deltas(resolution);
    std::uint64_t total = 0;
    for (int j = 0; j < resolution; ++j)
      for (int i = 0; i < resolution; ++i) total += deltas.top(i, j) + (j < resolution / 2 ? 4 * deltas.side(i, j) : 0);
    INFO("resolution " << resolution);
    CHECK(total == wholeShare);
  }
}

TEST_CASE("the delta form factors are the closed integrals over their pixels", "[hemicube]") {
  // The quadrature is exact to 1e-14 relative; the closed forms lose digits where corners cancel, four terms below
  // 1/4, each to about 1e-16.
  for (const int resolution : {2, 8, 32, 128, 512}) {
    const DeltaFormFactors deltas(resolution);
    bool holds = true;
    double top = 0, side = 0;
    const auto agree = [](std::uint64_t share, double exact) {
      return std::abs(formFactor(share) - exact) <= 1e-14 * exact + 4e-16;
    };
    const auto edge = [resolution](int i) { return 2.0 * i / resolution - 1; };
    for (int j = 0; j < resolution; ++j)
      for (int i = 0; i < resolution; ++i) {
        const double exact = pixel(toParallel, edge(i), edge(i + 1), edge(j), edge(j + 1));
        holds &= agree(deltas.top(i, j), exact);
        top += formFactor(deltas.top(i, j));
        if (j >= resolution / 2) continue;
        const double standing =
            pixel(toPerpendicular, 2.0 * j / resolution, 2.0 * (j + 1) / resolution, edge(i), edge(i + 1));
        holds &= agree(deltas.side(i, j), standing);
        side += formFactor(deltas.side(i, j));
      }
    INFO("resolution " << resolution);
    CHECK(holds);
    // A whole face: four corners of toParallel(1, 1), two of toPerpendicular(1, 1).
    CHECK(top == Approx(4 * toParallel(1, 1)).epsilon(1e-13));
    CHECK(side == Approx(2 * toPerpendicular(1, 1)).epsilon(1e-13));
  }
  CHECK(4 * toParallel(1, 1) == Approx(0.554126423979572).epsilon(1e-14));
  CHECK(2 * toPerpendicular(1, 1) == Approx(0.111468394005107).epsilon(1e-14));
}

TEST_CASE("every direction over the horizon is seen by exactly one pixel of the five faces", "[hemicube]") {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const auto direction = [&] { return glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random))); };
    const glm::dvec3 normal = direction();
    const glm::dvec3 up = repeat % 2 == 0 ? glm::dvec3(0) : direction();
    const auto faces = hemicubeFaces({1, 2, 3}, normal, up, 0.1, 64);
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 d = direction();
      int seen = 0;
      for (const raster::Face& face : faces) {
        const double w = glm::dot(glm::dvec3(face.w), d);
        const double i = (glm::dot(glm::dvec3(face.x), d) / w + 1) * 32;
        const double j = (glm::dot(glm::dvec3(face.y), d) / w + 1) * 32;
        const raster::Scissor& s = face.scissor;
        seen += w > 0 && i >= s.column && i < s.column + s.width && j >= s.row && j < s.row + s.height;
      }
      // The rows are rounded to binary32, so a direction that close to the horizon is not asked for.
      if (std::abs(glm::dot(d, normal)) > 1e-6) CHECK(seen == (glm::dot(d, normal) > 0 ? 1 : 0));
    }
    for (const raster::Face& face : faces) CHECK(raster::determinant(face) == Approx(1).epsilon(1e-6));
    if (repeat % 2 == 1) CHECK(glm::dot(glm::dvec3(faces[0].y), up) > 0);
  }
}

TEST_CASE("the near distance is the distance to the nearest triangle over the square root of three", "[hemicube]") {
  const Scene cube = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const double root3 = std::sqrt(3.0);
  // On the floor (triangles 4 and 5 are left out), 0.2 from the left wall.
  CHECK(nearDistance(cube, {0.2, 0, 0.6}, {4, 5}) == Approx(0.2 / root3).epsilon(1e-12));
  // Nothing left out: the point lies on the floor itself.
  CHECK(nearDistance(cube, {0.2, 0, 0.6}, {}) == smallestNearDistance * cube.extent);
  // Nearest to an edge and to a corner of a lone square in the plane y = 0, from outside of it.
  Scene lone;
  lone.surfaces = {tests::quad("lone", {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}})};
  lone.extent = 10;
  CHECK(nearDistance(lone, {0.5, 0.3, -0.4}, {}) == Approx(0.5 / root3).epsilon(1e-12));
  CHECK(nearDistance(lone, {-1, 2, 3}, {}) == Approx(3 / root3).epsilon(1e-12));  // 1, 2, 2 from the corner (0, 0, 1)
  CHECK(nearDistance(lone, {0.5, 0.3, -0.4}, {0, 1}) == lone.extent);
}

TEST_CASE("a hemicube leaves out its own surface's triangles in the tangent plane, and no others", "[hemicube]") {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  // A second piece of floor beside the first, coplanar but another surface, and a bent quad.
  scene.surfaces.push_back(tests::quad("beside", {{{1, 0, 0}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}}}));
  scene.surfaces.push_back(tests::quad("bent", {{{0, 3, 0}, {1, 3, 0}, {1, 3.5, 1}, {0, 3, 1}}}));
  scene = tests::finish(scene);
  CHECK(skippedTriangles(scene, 2, {{0.3, 0, 0.3}, {0, 1, 0}, 0}) == std::vector<std::uint32_t>{4, 5});
  const glm::dvec3 bent = normal(scene.surfaces[7].triangles[0]);
  CHECK(skippedTriangles(scene, 7, {{0.6, 3, 0}, bent, 0}) == std::vector<std::uint32_t>{14});
}

TEST_CASE("a row in a closed room is exactly one, from every patch", "[hemicube]") {
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 4);
  HemicubeRows rows = world.rows(64);
  for (std::uint32_t patch = 0; patch < world.discretization.patches.size(); ++patch) {
    const FormFactorRow row = rows.ofPatch(patch);
    CHECK(sum(row) == wholeShare);
    CHECK(row.background == 0);
    CHECK(row.back == 0);
    CHECK(toSurface(world, row, world.scene.surfaces[world.discretization.patches[patch].surface].name) == 0);
  }
}

TEST_CASE("what leaves an open room is the part of its row that is missing", "[hemicube]") {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  scene.surfaces.erase(scene.surfaces.begin() + 3);  // no ceiling
  World world(tests::finish(scene), 4, 4);
  const FormFactorRow row = world.rows(256).ofPatch(2);  // the one patch of the floor, from its centre
  CHECK(sum(row) == wholeShare);
  // The missing ceiling is a parallel unit square over the floor's centre, at distance one: four times the corner form
  // with sides of one half. Its outline passes between pixels of R = 256, so the pixels' integrals add up to it.
  CHECK(formFactor(row.background) == Approx(4 * toParallel(0.5, 0.5)).epsilon(1e-12));
  CHECK(row.back == 0);
}

TEST_CASE("unit squares see each other as the closed forms say", "[hemicube]") {
  // Howell C-11 at a = b = c, and by symmetry a quarter of the rest of the cube for each perpendicular square. Each
  // of 16 x 16 centres sees the pixels of R = 128 as whole, an error of up to half a pixel's share along outlines that
  // averages over the centres; the midpoint rule over centres 1/16 apart misses 1e-4 at the shared edges.
  const double parallel =
      2 / M_PI * (std::log(std::sqrt(4.0 / 3)) + 2 * std::sqrt(2.0) * std::atan(std::sqrt(0.5)) - M_PI / 2);
  const double perpendicular = (1 - parallel) / 4;
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 16, 1);
  CHECK(meanFactor(world, "floor", "ceiling", 128) == Approx(parallel).margin(2e-4));
  CHECK(meanFactor(world, "floor", "left", 128) == Approx(perpendicular).margin(2e-4));
  CHECK(meanFactor(world, "left", "back", 128) == Approx(perpendicular).margin(2e-4));
}

TEST_CASE("a point on the edge of a concave fold sees no back of the other side", "[hemicube]") {
  // Two squares that meet at a right angle along z, turned by every angle about it so that rounding to binary32 puts
  // the meeting line on either side; the eye stands on the line and belongs to the first square.
  for (int turn = 0; turn < 64; ++turn) {
    const double angle = 0.1 * turn;
    const glm::dvec3 x(std::cos(angle), std::sin(angle), 0), y(-std::sin(angle), std::cos(angle), 0), z(0, 0, 1);
    Scene scene;
    scene.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(1)));
    scene.surfaces = {tests::quad("floor", {{glm::dvec3(0), z, x + z, x}}),
                      tests::quad("wall", {{glm::dvec3(0), y, y + z, z}})};
    World world(tests::finish(scene), 4, 4);
    const FormFactorRow row = world.rows(64).from(0, {0.4 * z, y, 0});
    INFO("turned by " << angle);
    CHECK(row.back == 0);
  }
}

TEST_CASE("the back of a blocker is counted as back, not as an element", "[hemicube]") {
  // A square that hangs in the middle of the room and faces up: the floor sees only its back.
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  scene.surfaces.push_back(
      tests::quad("blocker", {{{0.25, 0.5, 0.25}, {0.25, 0.5, 0.75}, {0.75, 0.5, 0.75}, {0.75, 0.5, 0.25}}}));
  World world(tests::finish(scene), 4, 4);
  const FormFactorRow row = world.rows(256).ofPatch(2);
  CHECK(sum(row) == wholeShare);
  // From the centre of the floor: half-width 0.25 at distance 0.5, an outline between pixels again.
  CHECK(formFactor(row.back) == Approx(4 * toParallel(0.5, 0.5)).epsilon(1e-12));
  CHECK(toSurface(world, row, "blocker") == 0);
}
