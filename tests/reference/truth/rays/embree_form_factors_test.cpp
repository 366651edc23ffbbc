// RayRows: closed forms, RayFormFactors, exact sums, and starts that meet no adjacent surface.
#include "reference/truth/rays/embree_form_factors.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "tests/support/hand_scenes.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::reference;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

struct World {
  Scene scene;
  Discretization discretization;

  explicit World(Scene s, int texels = 1, int patch = 4)
      : scene(std::move(s)), discretization(discretize(scene, {.texels = texels, .patch = patch})) {}

  RayRows rows(int rays, RayStart start) const { return {scene, discretization, {.rays = rays, .start = start}}; }
};

constexpr RayStart bothStarts[] = {RayStart::Centre, RayStart::Area};

std::uint64_t sum(const FormFactorRow& row) {
  return std::accumulate(row.shares.begin(), row.shares.end(), row.background + row.back);
}

/// The form factors to all elements.
std::vector<double> factors(const World& world, const FormFactorRow& row) {
  std::vector<double> result(world.discretization.elements.size());
  for (std::size_t i = 0; i < row.elements.size(); ++i) result[row.elements[i]] = formFactor(row.shares[i]);
  return result;
}

/// The standard deviation of a form factor with this number of independent rays.
double byChance(double factor, int rays) { return std::sqrt(factor * (1 - factor) / rays); }

bool areEqual(const FormFactorRow& a, const FormFactorRow& b) {
  return a.elements == b.elements && a.shares == b.shares && a.background == b.background && a.back == b.back;
}

/// Rotated about z and then about x, by angles in radians.
Scene turned(Scene scene, double aboutZ, double aboutX) {
  const double a = std::cos(aboutZ), b = std::sin(aboutZ), c = std::cos(aboutX), d = std::sin(aboutX);
  const glm::dmat3 first(a, b, 0, -b, a, 0, 0, 0, 1), then(1, 0, 0, 0, c, d, 0, -d, c);
  for (Surface& surface : scene.surfaces)
    for (Triangle& triangle : surface.triangles)
      for (glm::dvec3& corner : triangle.position) corner = then * (first * corner);
  return tests::finish(std::move(scene));
}

}  // namespace

TEST_CASE("RayRows give rows of exactly one, with shares that are integer numbers of rays", "[ray rows]") {
  const World world(tests::furnishedRoom(), 4, 2);
  for (const RayStart start : bothStarts)
    for (const int rays : {16, 1 << 11}) {
      RayRows rows = world.rows(rays, start);
      for (std::uint32_t patch = 0; patch < world.discretization.patches.list.size(); ++patch) {
        const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[patch]);
        CHECK(sum(row) == wholeShare);
        CHECK(row.background == 0);
        CHECK(std::is_sorted(row.elements.begin(), row.elements.end()));
        bool areWhole = row.elements.size() == row.shares.size();
        for (const std::uint64_t share : row.shares) areWhole &= share > 0 && share % (wholeShare / rays) == 0;
        CHECK(areWhole);
      }
    }
}

TEST_CASE("RayRows equal the closed forms, with smaller errors than random rays", "[ray rows]") {
  // A closed cube of 6 x 9 elements. The error from a patch's centre is below four standard deviations of random rays.
  // Rays of low discrepancy have random errors only along the outlines of elements. So their root mean square error is
  // half of that of random rays.
  constexpr int rays = 1 << 14;
  const World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 3);
  const SurfacePieces pieces = surfacePieces(world.scene, world.discretization);
  RayRows rows = world.rows(rays, RayStart::Centre);
  double squares = 0, expected = 0;
  for (std::uint32_t patch = 0; patch < world.discretization.patches.list.size(); ++patch) {
    const Patch& block = world.discretization.patches.list[patch];
    const SurfacePoint centre = patchCentre(world.scene, world.discretization, block);
    const std::vector<double> row = factors(world, rows.ofPatch(world.discretization.patches.list[patch]));
    for (std::uint32_t e = 0; e < row.size(); ++e) {
      double exact = 0;
      for (const SurfacePiece& piece : pieces.of(e))
        exact += pointToPolygon(inFrame(world.scene, centre.position), centre.normal, piece.corner);
      CHECK(std::abs(row[e] - exact) <= 4 * byChance(exact, rays));
      squares += std::pow(row[e] - exact, 2);
      expected += std::pow(byChance(exact, rays), 2);
    }
  }
  CHECK(std::sqrt(squares / expected) < 0.5);
}

TEST_CASE("RayRows with starts over an area give the mean over its points", "[ray rows]") {
  // Parallel unit squares, Howell C-11, and a blocker over half of them that hides exactly a half (see
  // monte_carlo_form_factors_test.cpp), seen from its back. It absorbs what it hides. The errors of points of low
  // discrepancy are a fifth of the standard deviation of random rays, so that they are below a half.
  constexpr int rays = 1 << 16;
  const AxisRectangle square{{0, 1}, {0, 1}};
  for (const double gap : {0.1, 1.0}) {
    const World world(tests::sceneOf({tests::parallelogram("under", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                      tests::parallelogram("over", {0, 0, gap}, {0, 1, 0}, {1, 0, 0}),
                                      tests::parallelogram("half", {-9, -9, gap / 2}, {9.5, 0, 0}, {0, 20, 0})}));
    const double open = parallelRectangles(square, square, gap);
    const FormFactorRow row = world.rows(rays, RayStart::Area).ofPatch(world.discretization.patches.list[0]);
    CHECK(std::abs(factors(world, row)[1] - open / 2) <= byChance(open / 2, rays) / 2);
    const double toBlocker = parallelRectangles(square, {{-9, 0.5}, {-9, 11}}, gap / 2);
    CHECK(std::abs(formFactor(row.back) - toBlocker) <= byChance(toBlocker, rays) / 2);
    // All from the centre: half of the point's form factor.
    const double point = elementToParallelRectangle({{-0.5, 0.5}, {-0.5, 0.5}}, gap);
    const FormFactorRow centre = world.rows(rays, RayStart::Centre).ofPatch(world.discretization.patches.list[0]);
    CHECK(std::abs(factors(world, centre)[1] - point / 2) <= 4 * byChance(point / 2, rays));
  }
}

TEST_CASE("RayRows agree with RayFormFactors", "[ray rows]") {
  // The standard errors of RayFormFactors are larger than those of the four times as many rays of RayRows.
  constexpr int samples = 1 << 13;
  const World world(tests::furnishedRoom(), 4, 2);
  const RayFormFactors slow(world.scene, world.discretization);
  const Receivers receivers = everyElement(world.discretization);
  std::size_t beyond = 0, values = 0;
  for (const RayStart start : bothStarts) {
    RayRows rows = world.rows(4 * samples, start);
    for (std::uint32_t patch = 0; patch < world.discretization.patches.list.size(); patch += 3) {
      const Patch& block = world.discretization.patches.list[patch];
      const RaySource raySource =
          start == RayStart::Area
              ? areaRaySource(slow.pieces(), block.elements)
              : pointRaySource(world.scene, block.surface, patchCentre(world.scene, world.discretization, block));
      const MeasuredRow measured = slow.overHemisphere(raySource, receivers, {samples, patch});
      const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[patch]);
      const std::vector<double> fast = factors(world, row);
      const auto differ = [&](const Measurement& measurement, double value) {
        return std::abs(measurement.value - value) > 4 * std::sqrt(2.0) * measurement.standardError + 1e-9;
      };
      for (std::uint32_t e = 0; e < fast.size(); ++e) beyond += differ(measured.receivers[e], fast[e]);
      beyond += differ(measured.back, formFactor(row.back));
      values += fast.size() + 1;
    }
  }
  INFO(beyond << " of " << values);
  CHECK(beyond <= values / 500);
}

TEST_CASE("RayRows never meet the start surface, or the back of a wall beside the start", "[ray rows]") {
  // A room rotated in many ways, so that rounding to binary32 puts edges on either side of each other. Starts lie all
  // over its faces, up to their edges.
  for (int turn = 0; turn < 32; ++turn) {
    const World world(turned(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 0.1 + 0.2 * turn, 0.7 * turn));
    RayRows rows = world.rows(1 << 12, RayStart::Area);
    for (std::uint32_t patch = 0; patch < 6; ++patch) {
      const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[patch]);
      INFO("turn " << turn << ", patch " << patch);
      CHECK(row.back == 0);
      CHECK(row.background == 0);
      CHECK(row.elements.size() == 5);
      CHECK(factors(world, row)[patch] == 0);
    }
  }
}

TEST_CASE("RayRows lose no ray between the triangles of a closed room", "[ray rows]") {
  // A cube whose faces are cut into 2 x 32 x 32 triangles, rotated so that almost no corner is exact in binary32.
  constexpr int steps = 32;
  std::vector<Surface> surfaces;
  for (const Surface& face : tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)).surfaces) {
    const std::array<glm::dvec3, 3>& corner = face.triangles[0].position;
    const glm::dvec3 u = (corner[1] - corner[0]) / double(steps), v = (corner[2] - corner[1]) / double(steps);
    std::vector<Triangle> triangles;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const auto at = [&](int column, int row) {
          return tests::Corner{corner[0] + double(column) * u + double(row) * v,
                               glm::dvec2(column, row) / double(steps)};
        };
        triangles.push_back(tests::triangleOf(at(i, j), at(i + 1, j), at(i + 1, j + 1)));
        triangles.push_back(tests::triangleOf(at(i, j), at(i + 1, j + 1), at(i, j + 1)));
      }
    surfaces.push_back(tests::surfaceOf(face.name, std::move(triangles)));
  }
  const World world(turned(tests::sceneOf(std::move(surfaces)), 0.3, 0.7));
  for (const RayStart start : bothStarts) {
    RayRows rows = world.rows(1 << 17, start);
    for (std::uint32_t patch = 0; patch < 6; ++patch) {
      const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[patch]);
      CHECK(row.background == 0);
      CHECK(row.back == 0);
      CHECK(factors(world, row)[patch] == 0);
    }
  }
}

TEST_CASE("RayRows miss a receiver of less light than a ray, or give it all the light of a ray", "[ray rows]") {
  // Squares of side a at (x, y, 1) facing down receive a^2 cos^4 / pi of the light of the point below the origin: with
  // this side, 1e-8 each.
  std::vector<Surface> surfaces{tests::parallelogram("floor", {-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0})};
  for (int i = 0; i < 100; ++i) {
    const double x = -0.45 + 0.1 * (i % 10), y = -0.45 + 0.1 * (i / 10);
    const double side = std::sqrt(1e-8 * M_PI) * (x * x + y * y + 1);
    surfaces.push_back(tests::parallelogram("receiver" + std::to_string(i), {x, y, 1}, {0, side, 0}, {side, 0, 0}));
  }
  const World world(tests::sceneOf(std::move(surfaces)));
  CHECK(world.rows(1 << 12, RayStart::Centre).ofPatch(world.discretization.patches.list[0]).elements.empty());
  constexpr int rays = 1 << 20;
  const FormFactorRow row = world.rows(rays, RayStart::Centre).ofPatch(world.discretization.patches.list[0]);
  CHECK(row.elements.size() < 5);  // 1.05 on average
  for (const std::uint64_t share : row.shares) CHECK(share == wholeShare / rays);
}

TEST_CASE("RayRows meet slivers of a millionth of their length as often as others", "[ray rows]") {
  // 64 strips that cross over the middle of a floor. The point there sends them a few 1e-5 of its light, known in
  // closed form.
  constexpr double width = 1e-6;
  std::vector<Surface> surfaces{tests::parallelogram("floor", {-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0})};
  for (int i = 0; i < 64; ++i) {
    const double angle = 0.05 * i;
    const glm::dvec3 along(std::cos(angle), std::sin(angle), 0), across(-width * along.y, width * along.x, 0);
    surfaces.push_back(
        tests::parallelogram("strip", glm::dvec3(0, 0, 0.3 + 0.004 * i) - 0.5 * (along + across), across, along));
  }
  const World world(tests::sceneOf(std::move(surfaces)));
  double exact = 0;
  for (const SurfacePiece& piece : surfacePieces(world.scene, world.discretization).pieces)
    exact += pointToPolygon(inFrame(world.scene, {0, 0, 0}), {0, 0, 1}, piece.corner);
  constexpr int rays = 1 << 20;
  const FormFactorRow row = world.rows(rays, RayStart::Centre).ofPatch(world.discretization.patches.list[0]);
  const double found = formFactor(std::accumulate(row.shares.begin(), row.shares.end(), std::uint64_t{0}));
  CHECK(std::abs(found - exact) <= 4 * byChance(exact, rays));
  CHECK(row.back == 0);
}

TEST_CASE("RayRows in two-sided scenes pass backs and meet their twins", "[ray rows]") {
  // A sheet halfway between two squares, with a twin: each square sees one side of it, as large as itself.
  constexpr int rays = 1 << 14;
  const AxisRectangle square{{0, 1}, {0, 1}};
  Scene scene = tests::sceneOf({tests::parallelogram("under", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                tests::parallelogram("over", {0, 0, 1}, {0, 1, 0}, {1, 0, 0}),
                                tests::parallelogram("sheet", {0, 0, 0.5}, {0, 1, 0}, {1, 0, 0}),
                                tests::parallelogram("twin", {0, 0, 0.5}, {1, 0, 0}, {0, 1, 0})});
  makeTwins(scene.surfaces, 2, 3);
  const World world(scene);
  RayRows rows = world.rows(rays, RayStart::Area);
  const double exact = parallelRectangles(square, square, 0.5);
  for (const auto& [from, to] : {std::pair<std::uint32_t, std::uint32_t>{0, 2}, {1, 3}}) {
    const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[from]);
    CHECK(row.elements == std::vector{to});
    CHECK(std::abs(factors(world, row)[to] - exact) <= 4 * byChance(exact, rays));
    CHECK(row.back == 0);
  }
  for (const auto& [from, to] : {std::pair<std::uint32_t, std::uint32_t>{2, 0}, {3, 1}})
    CHECK(rows.ofPatch(world.discretization.patches.list[from]).elements == std::vector{to});
}

TEST_CASE("RayRows give the same bits for any number of threads", "[ray rows]") {
  // Coincident bumps of some thousand triangles. Embree's tree decides which of them a ray meets, and that must not
  // depend on the threads that build it.
  Surface first = tests::bump(40), second = first;
  second.name = second.family = "again";
  Scene scene = tests::sceneOf({first, second, tests::parallelogram("lid", {0, 0, 2}, {0, 2, 0}, {3, 0, 0})});
  const World world(std::move(scene), 8);
  const auto rowsOf = [&](int threads) {
    const raster::ThreadLimit limit(threads);
    std::vector<FormFactorRow> result;
    for (const RayStart start : bothStarts) {
      RayRows rows = world.rows(1 << 13, start);
      for (std::uint32_t patch = 0; patch < world.discretization.patches.list.size(); ++patch)
        result.push_back(rows.ofPatch(world.discretization.patches.list[patch]));
    }
    return result;
  };
  const std::vector<FormFactorRow> one = rowsOf(1);
  for (const int threads : {2, 7}) {
    const std::vector<FormFactorRow> other = rowsOf(threads);
    CHECK(std::equal(one.begin(), one.end(), other.begin(), other.end(), areEqual));
  }
}

TEST_CASE("RayRows leave the floating-point mode of all threads unchanged", "[ray rows]") {
  // Embree flushes subnormal numbers to 0; no thread of the program may keep that mode.
  const World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)));
  world.rows(1 << 14, RayStart::Centre).ofPatch(world.discretization.patches.list[0]);
  std::atomic<int> flushed = 0;
  raster::parallelFor(1000, [&](std::size_t) {
    volatile double smallest = std::numeric_limits<double>::min();
    flushed += smallest / 2 == 0;
  });
  CHECK(flushed == 0);
}
