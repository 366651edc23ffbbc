// Form-factor rows by hemicubes: they sum to one, and equal closed forms.
#include "radiosity/form_factors/projected_form_factors.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "tests/support/box_scene.h"
#include "tests/support/corner_form_factors.h"
#include "tests/support/hemicube_world.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::toParallel;

namespace {

using World = tests::HemicubeWorld;

std::uint64_t sumOfRow(const FormFactorRow& row) {
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
  ProjectedFormFactors rows = world.rows(resolution);
  double factor = 0;
  int count = 0;
  for (std::uint32_t p = 0; p < world.discretization.patches.list.size(); ++p)
    if (world.scene.surfaces[world.discretization.patches.list[p].surface].name == from) {
      factor += toSurface(world, rows.ofPatch(world.discretization.patches.list[p]), to);
      ++count;
    }
  return factor / count;
}

}  // namespace

TEST_CASE("ProjectedFormFactors in a closed room give rows of exactly one, from every patch", "[rows]") {
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 4);
  ProjectedFormFactors rows = world.rows(64);
  for (std::uint32_t patch = 0; patch < world.discretization.patches.list.size(); ++patch) {
    const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[patch]);
    CHECK(sumOfRow(row) == wholeShare);
    CHECK(row.background == 0);
    CHECK(row.back == 0);
    CHECK(toSurface(world, row, world.scene.surfaces[world.discretization.patches.list[patch].surface].name) == 0);
  }
}

TEST_CASE("ProjectedFormFactors in an open room give rows whose background is the light that leaves", "[rows]") {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  scene.surfaces.erase(scene.surfaces.begin() + 3);  // no ceiling
  World world(tests::finish(scene), 4, 4);
  const FormFactorRow row =
      world.rows(256).ofPatch(world.discretization.patches.list[2]);  // the one patch of the floor, from its centre
  CHECK(sumOfRow(row) == wholeShare);
  // The missing ceiling is a parallel unit square over the floor's centre, at distance one: four times the corner form
  // with sides of one half. Its outline passes between pixels of R = 256, so that the integrals of pixels add up to it.
  CHECK(formFactor(row.background) == Approx(4 * toParallel(0.5, 0.5)).epsilon(1e-12));
  CHECK(row.back == 0);
}

TEST_CASE("ProjectedFormFactors of unit squares agree with closed forms", "[rows]") {
  // Howell C-11 at a = b = c, and by symmetry a quarter of the rest of the cube for each perpendicular square. Each of
  // 16 x 16 centres counts whole pixels of R = 128. That gives an error of up to half a pixel's share along outlines,
  // which averages out over the centres. The midpoint rule over centres 1/16 apart has an error of 1e-4 at the shared
  // edges.
  const double parallel =
      2 / M_PI * (std::log(std::sqrt(4.0 / 3)) + 2 * std::sqrt(2.0) * std::atan(std::sqrt(0.5)) - M_PI / 2);
  const double perpendicular = (1 - parallel) / 4;
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 16, 1);
  CHECK(meanFactor(world, "floor", "ceiling", 128) == Approx(parallel).margin(2e-4));
  CHECK(meanFactor(world, "floor", "left", 128) == Approx(perpendicular).margin(2e-4));
  CHECK(meanFactor(world, "left", "back", 128) == Approx(perpendicular).margin(2e-4));
}

TEST_CASE("ProjectedFormFactors from a point on the edge of a concave fold see no back of the other side", "[rows]") {
  // Two squares that meet at a right angle along z. They are rotated about z by many angles, so that rounding to
  // binary32 puts the common edge on either side. The eye lies on the edge and belongs to the first square.
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

TEST_CASE("ProjectedFormFactors count the back of a blocker as back, not as an element", "[rows]") {
  // A square that hangs in the middle of the room and faces up: the floor sees only its back.
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  scene.surfaces.push_back(
      tests::quad("blocker", {{{0.25, 0.5, 0.25}, {0.25, 0.5, 0.75}, {0.75, 0.5, 0.75}, {0.75, 0.5, 0.25}}}));
  World world(tests::finish(scene), 4, 4);
  const FormFactorRow row = world.rows(256).ofPatch(world.discretization.patches.list[2]);
  CHECK(sumOfRow(row) == wholeShare);
  // From the centre of the floor: half-width 0.25 at distance 0.5, again with an outline between pixels.
  CHECK(formFactor(row.back) == Approx(4 * toParallel(0.5, 0.5)).epsilon(1e-12));
  CHECK(toSurface(world, row, "blocker") == 0);
}

TEST_CASE("ProjectedFormFactors with a cubic tetrahedron in a closed room give rows of exactly one, from every patch",
          "[rows]") {
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 4);
  ProjectedFormFactors rows(world.scene, world.discretization, world.layout, world.renderer,
                            {64, Orientation::Turned, ProjectionKind::CubicTetrahedron});
  for (std::uint32_t patch = 0; patch < world.discretization.patches.list.size(); ++patch) {
    const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[patch]);
    CHECK(sumOfRow(row) == wholeShare);
    CHECK(row.background == 0);
    CHECK(row.back == 0);
    CHECK(std::find(row.shares.begin(), row.shares.end(), 0) == row.shares.end());
    CHECK(toSurface(world, row, world.scene.surfaces[world.discretization.patches.list[patch].surface].name) == 0);
  }
}

TEST_CASE("ProjectedFormFactors with a single plane in a closed room count the light not captured as background",
          "[rows]") {
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 4);
  ProjectedFormFactors rows(world.scene, world.discretization, world.layout, world.renderer,
                            {64, Orientation::Turned, ProjectionKind::SinglePlane});
  const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[9]);
  CHECK(sumOfRow(row) == wholeShare);
  CHECK(row.background == wholeShare - rows.projection().captured);
  CHECK(row.back == 0);
  // Closed form of a square of half-width 4 at distance 1.
  CHECK(formFactor(row.background) == Approx(1 - 4 * toParallel(4, 4)).epsilon(1e-12));
}

TEST_CASE("ProjectedFormFactors with all projections converge to the same form factors", "[rows]") {
  // From the middle of the floor of a unit cube: the ceiling is a parallel square at distance 1, half-width one half;
  // each wall has a quarter of the rest. The plane misses the part of the walls below 1/4 of their distance.
  World world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 1, 1);
  const double ceiling = 4 * toParallel(0.5, 0.5), wall = (1 - ceiling) / 4;
  const double underPlane = (1 - 4 * toParallel(4, 4)) / 4;
  for (const ProjectionKind kind :
       {ProjectionKind::Hemicube, ProjectionKind::SinglePlane, ProjectionKind::CubicTetrahedron})
    for (const int resolution : {64, 1024}) {
      ProjectedFormFactors rows(world.scene, world.discretization, world.layout, world.renderer,
                                {resolution, Orientation::Aligned, kind});
      const FormFactorRow row = rows.ofPatch(world.discretization.patches.list[2]);
      const double lost = kind == ProjectionKind::SinglePlane ? underPlane : 0;
      // An outline of length l on a face has an error of at most half a pixel's share along it. That of the ceiling, of
      // length 4 at distance 1, has a density of at most 1 / pi (1.25)^2, and pixels are up to 8 / R wide.
      const double margin = 0.5 * 8.0 / resolution * 4 / (M_PI * 1.25 * 1.25);
      INFO("projection " << static_cast<int>(kind) << ", R = " << resolution);
      CHECK(toSurface(world, row, "ceiling") == Approx(ceiling).margin(margin));
      for (const char* name : {"left", "right", "back", "front"})
        CHECK(toSurface(world, row, name) == Approx(wall - lost).margin(margin));
    }
}
