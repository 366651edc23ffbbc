// PatchSubdivision: the parts of a patch near its receivers, and the accuracy gained.
#include "radiosity/form_factors/patch_subdivision.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/solver/progressive_solver.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Two unit squares that face each other.
Scene facingSquares(double gap) {
  Scene scene;
  scene.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(1)));
  scene.surfaces = {tests::parallelogram("under", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                    tests::parallelogram("over", {0, 0, gap}, {0, 1, 0}, {1, 0, 0})};
  return tests::finish(std::move(scene));
}

/// The discretization after splitting every patch with weight 1.
Discretization splitPatches(tests::HemicubeWorld& world, double maxReturning) {
  Discretization discretization = world.discretization;
  PatchSubdivision subdivision(world.scene, discretization, world.layout, world.renderer, maxReturning);
  discretization.patches = splitAll(
      world.discretization.patches,
      [&](const auto& patches, const auto& patch, double weight) { return subdivision.split(patches, patch, weight); });
  return discretization;
}

/// The form factor between the two squares, by hemicubes over points x points of the first.
double exchanged(double gap, int points, int resolution) {
  tests::HemicubeWorld world(facingSquares(gap), 1, 1);
  world.discretization.patches.list.front().points = points;
  const FormFactorRow row = world.rows(resolution).ofPatch(world.discretization.patches.list.front());
  REQUIRE(row.elements == std::vector<std::uint32_t>{1});
  return formFactor(row.shares.front());
}

/// Checks that each element belongs to one patch whose block contains its texel, and that patches and elements refer to
/// each other.
void checkPartition(const Discretization& discretization) {
  std::vector<int> owners(discretization.elements.size(), 0);
  const auto ofSurfaces = patchesOfSurfaces(discretization.patches, discretization.grids.size());
  for (std::uint32_t p = 0; p < discretization.patches.list.size(); ++p) {
    const Patch& patch = discretization.patches.list[p];
    const Grid& grid = discretization.grids[patch.surface];
    CHECK(patch.number == p);
    CHECK(!patch.elements.empty());
    CHECK(std::binary_search(ofSurfaces[patch.surface].begin(), ofSurfaces[patch.surface].end(), p));
    double area = 0;
    for (const std::uint32_t e : patch.elements) {
      const Element& element = discretization.elements[e];
      const int column = static_cast<int>(element.texel) % grid.columns,
                row = static_cast<int>(element.texel) / grid.columns;
      ++owners[e];
      area += element.area;
      CHECK(discretization.patches.ofElement[e] == p);
      CHECK(element.surface == patch.surface);
      CHECK((column >= patch.column && column < patch.column + patch.width));
      CHECK((row >= patch.row && row < patch.row + patch.height));
    }
    CHECK(patch.area == area);
  }
  CHECK(std::count(owners.begin(), owners.end(), 1) == static_cast<std::ptrdiff_t>(owners.size()));
}

}  // namespace

TEST_CASE("shootingBlocks: one point is too few for squares that face each other, and 8 x 8 are enough",
          "[patch_splitting]") {
  // Howell C-11 gives 0.199825 at a gap of one side and 0.415253 at half a side. From the middle, the point's closed
  // form is 0.239391 (20 % more) and 0.554126 (33 % more), which is the result of one hemicube. The midpoint rule over
  // 8 x 8 hemicubes has errors of 0.24 % and 0.42 %.
  struct Row {
    double gap, onePoint, manyPoints;
  };
  for (const Row& row : {Row{1, 0.198, 0.0024}, Row{0.5, 0.3345, 0.0042}}) {
    CAPTURE(row.gap);
    const double exact = tests::parallelRectangles({{0, 1}, {0, 1}}, {{0, 1}, {0, 1}}, row.gap);
    CHECK(exchanged(row.gap, 1, 1024) / exact - 1 == Approx(row.onePoint).margin(1e-3));
    CHECK(exchanged(row.gap, 8, 256) / exact - 1 == Approx(row.manyPoints).margin(4e-4));
  }
}

TEST_CASE("PatchSubdivision brings the form factor of facing squares to the closed form, for all gaps",
          "[patch_splitting]") {
  // From one point the form factor F has a relative error of about F (20 % at F = 0.2, 5.6 % at 0.0686, 2 % at 0.0190).
  // That equals the share F^2 of all light that returns, up to a tenth. With n x n parts, each has 1 / n^2 of the light
  // and of the share. So n doubles until F^2 / n^4 is at most 0.002. All parts together have an error of F^2 / n^2,
  // which is at most F sqrt(0.002).
  for (const double gap : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    CAPTURE(gap);
    tests::HemicubeWorld world(facingSquares(gap), 1, 1);
    world.discretization = splitPatches(world, 0.002);
    const FormFactorRow row = ProjectedFormFactors(world.scene, world.discretization, world.layout, world.renderer,
                                                   {1024, Orientation::Turned})
                                  .ofPatch(world.discretization.patches.list.front());
    const double exact = tests::parallelRectangles({{0, 1}, {0, 1}}, {{0, 1}, {0, 1}}, gap);
    CHECK(formFactor(row.shares.front()) == Approx(exact).margin(1.1 * exact * std::sqrt(0.002)));
  }
}

TEST_CASE("PatchSubdivision keeps the elements and distributes them to its patches", "[patch_splitting]") {
  Scene rings;
  rings.materials.push_back(tests::material("grey", glm::dvec3(0.5), glm::dvec3(1)));
  rings.surfaces = {tests::ring(24), tests::parallelogram("over", {0, 0, 0.1}, {0, 1, 0}, {1, 0, 0})};
  for (const Scene& scene : {tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), tests::finish(std::move(rings))})
    for (const int texels : {1, 5, 16})
      for (const double maxReturning : {0.1, 0.02, 1e-6}) {
        CAPTURE(texels, maxReturning);
        tests::HemicubeWorld world(scene, texels, 4);
        const Discretization after = splitPatches(world, maxReturning);
        checkPartition(after);
        CHECK(after.patches.list.size() >= world.discretization.patches.list.size());
        for (std::size_t e = 0; e < after.elements.size(); ++e)
          CHECK(after.elements[e].area == world.discretization.elements[e].area);
        for (const Patch& patch : after.patches.list) {
          CHECK(patch.halvings <= maxHalvings);
          if (patch.points > 1) CHECK((patch.width == 1 && patch.height == 1));
        }
      }
}

TEST_CASE("SceneFormFactors with a limit of 1 split nothing", "[patch_splitting]") {
  tests::HemicubeWorld world(facingSquares(1e-3), 4, 2);
  SceneFormFactors drawn(world.scene, world.discretization, world.layout, {.split = 1});
  CHECK_FALSE(drawn.splits());
  const Patches after = splitAll(world.discretization.patches, drawn.splits());
  CHECK(after.list.size() == world.discretization.patches.list.size());
  for (const Patch& patch : after.list) CHECK((patch.points == 1 && patch.halvings == 0));
}

TEST_CASE("PatchSubdivision in a cube splits the patches along the edges and not those in the middle",
          "[patch_splitting]") {
  tests::HemicubeWorld world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 16, 4);
  const Discretization after = splitPatches(world, 0.03);
  for (const Patch& patch : after.patches.list) {
    const bool isAtEdge =
        patch.column == 0 || patch.row == 0 || patch.column + patch.width == 16 || patch.row + patch.height == 16;
    const bool isInMiddle =
        patch.column >= 4 && patch.row >= 4 && patch.column + patch.width <= 12 && patch.row + patch.height <= 12;
    if (isAtEdge) CHECK(patch.halvings > 0);
    if (isInMiddle) CHECK(patch.halvings == 0);
  }
}

TEST_CASE("PatchSubdivision reduces the error of the light in a cube", "[patch_splitting]") {
  // In a furnace each element has the same radiosity, E / (1 - r) = 2; the difference is the error. With one patch per
  // face, edges get too little light and middles too much. A quarter has a quarter of the flux and of the returning
  // share, so that patches half as wide need a sixteenth of the limit.
  const auto worst = [](double maxReturning) {
    tests::HemicubeWorld world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8, 8);
    if (maxReturning < 1) world.discretization = splitPatches(world, maxReturning);
    ProjectedFormFactors rows(world.scene, world.discretization, world.layout, world.renderer,
                              {256, Orientation::Turned});
    const Solution solution = solve({.scene = world.scene,
                                     .discretization = world.discretization,
                                     .patches = world.discretization.patches,
                                     .rowOf = [&](const Patch& p) { return rows.ofPatch(p); },
                                     .settings = {.residual = 1e-6}});
    double largest = 0;
    for (const glm::dvec3& b : solution.radiosity) largest = std::max(largest, std::abs(b.x - 2));
    return largest;
  };
  const double whole = worst(1), quarters = worst(0.0125), finer = worst(0.0125 / 16);
  CHECK(whole > 0.2);
  CHECK(quarters < whole / 3);
  CHECK(finer < quarters / 3);
}

TEST_CASE("turnOf spreads the rotations of hemicubes over a quarter turn", "[patch_splitting]") {
  // Multiples of the golden section: of n of them, neighbours on the circle are between 0.38 / n and 1.9 / n apart.
  // (Three distance theorem: there are at most three distances, in golden ratios of each other.)
  for (const std::uint32_t count : {8U, 100U, 1000U}) {
    std::vector<double> turns;
    for (std::uint32_t patch = 0; patch < count; ++patch) turns.push_back(turnOf(patch, 0));
    std::sort(turns.begin(), turns.end());
    CHECK((turns.front() >= 0 && turns.back() < 1));
    turns.push_back(turns.front() + 1);
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
      CHECK((turns[i + 1] - turns[i]) * count > 0.38);
      CHECK((turns[i + 1] - turns[i]) * count < 1.9);
    }
  }
}

TEST_CASE("ProjectedFormFactors with rotated hemicubes see the same room", "[patch_splitting]") {
  // From the middle of a face of a cube, closed forms give the opposite and the adjacent faces. A rotation moves
  // pixels. Each of about 4 R pixels along a face's outline may randomly change sides: 4 sqrt(4 R) pixels of at most 4
  // / (pi R^2).
  constexpr int resolution = 128;
  tests::HemicubeWorld world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 1, 1);
  ProjectedFormFactors aligned = world.rows(resolution);
  ProjectedFormFactors turned(world.scene, world.discretization, world.layout, world.renderer,
                              {resolution, Orientation::Turned});
  for (const Patch& patch : world.discretization.patches.list) {
    const FormFactorRow a = aligned.ofPatch(patch), b = turned.ofPatch(patch);
    REQUIRE(a.elements == b.elements);
    CHECK(b.background == 0);
    CHECK((patch.number == 0) == (a.shares == b.shares));  // the rotation of the first patch is 0
    const double bound = 4 * std::sqrt(4.0 * resolution) * 4 / (3.14159 * resolution * resolution);
    for (std::size_t i = 0; i < a.shares.size(); ++i)
      CHECK(std::abs(formFactor(a.shares[i]) - formFactor(b.shares[i])) < bound);
  }
}
