/// Quadtree leaves as elements, from texels to form-factor rows, and the choice of leaves to split.
#include "radiosity/discretization/adaptive_subdivision.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/form_factors/patch_subdivision.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/input_error.h"
#include "reference/truth/rays/embree_form_factors.h"
#include "reference/truth/solution/ground_truth.h"
#include "reference/truth/solution/radiosity_error.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/random_quadtrees.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

constexpr int texels = 16;

std::vector<Quadtree> randomQuadtrees(const Scene& scene, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Quadtree> trees;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) trees.push_back(randomQuadtree(texels, random));
  return trees;
}

/// A discretization into texels, and the same with quadtrees.
struct TexelsAndLeaves {
  Scene scene;
  Discretization ofTexels, ofLeaves;

  TexelsAndLeaves(Scene s, const std::vector<Quadtree>& trees, int patch)
      : scene(std::move(s)),
        ofTexels(discretize(scene, {.texels = texels, .patch = patch})),
        ofLeaves(discretize(scene, {.texels = texels, .patch = patch}, trees)) {}

  /// For each element of `ofTexels`, the element of the leaf that contains its own texel.
  std::vector<std::uint32_t> leafElements() const { return reference::elementsUnder(ofLeaves, ofTexels); }
};

/// Shares by element.
std::map<std::uint32_t, std::uint64_t> sharesOf(const FormFactorRow& row, const std::vector<std::uint32_t>& element) {
  std::map<std::uint32_t, std::uint64_t> shares;
  for (std::size_t i = 0; i < row.elements.size(); ++i) shares[element[row.elements[i]]] += row.shares[i];
  return shares;
}

std::vector<std::uint32_t> themselves(const Discretization& discretization) {
  std::vector<std::uint32_t> elements(discretization.elements.size());
  std::iota(elements.begin(), elements.end(), 0u);
  return elements;
}

/// A scene of one square of side 1.
Scene unitSquare() { return sceneOf({parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})}); }

/// The radiosity at the middle of each leaf's element of one surface.
std::vector<glm::dvec3> atMiddles(const Scene& scene, const Discretization& discretization,
                                  const std::function<double(const glm::dvec3&)>& radiosity) {
  std::vector<glm::dvec3> values;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
    values.emplace_back(radiosity(elementCentre(scene, discretization, e).position), 0, 0);
  return values;
}

}  // namespace

TEST_CASE("discretize with quadtrees of single texels equals discretize without quadtrees", "[adaptive]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  const TexelsAndLeaves both(scene, std::vector(scene.surfaces.size(), uniformQuadtree(texels, 1)), 4);
  REQUIRE(both.ofLeaves.elements.size() == both.ofTexels.elements.size());
  CHECK(both.ofLeaves.patches.ofElement == both.ofTexels.patches.ofElement);
  CHECK(both.ofLeaves.triangleOf == both.ofTexels.triangleOf);
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    CHECK(both.ofLeaves.grids[s].elementOfTexel == both.ofTexels.grids[s].elementOfTexel);
  for (std::uint32_t e = 0; e < both.ofTexels.elements.size(); ++e) {
    const Element &a = both.ofLeaves.elements[e], &b = both.ofTexels.elements[e];
    CHECK((a.area == b.area && a.texel == b.texel));
    CHECK(elementCentre(scene, both.ofLeaves, e).position == elementCentre(scene, both.ofTexels, e).position);
  }
}

TEST_CASE("discretize gives a leaf's element the sum of the elements of its texels", "[adaptive]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  const TexelsAndLeaves both(scene, randomQuadtrees(scene, 1), 4);
  const std::vector<std::uint32_t> leafElement = both.leafElements();
  std::vector<double> area(both.ofLeaves.elements.size());
  for (std::uint32_t e = 0; e < leafElement.size(); ++e) {
    const Element &small = both.ofTexels.elements[e], &large = both.ofLeaves.elements[leafElement[e]];
    const Grid& grid = both.ofLeaves.grids[small.surface];
    area[leafElement[e]] += small.area;
    REQUIRE(leafOf(grid, small.texel) == leafOf(grid, large.texel));
    REQUIRE(large.texel <= small.texel);  // the first own texel of the leaf
  }
  for (std::uint32_t e = 0; e < area.size(); ++e)
    CHECK(both.ofLeaves.elements[e].area == Approx(area[e]).epsilon(1e-12));
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    for (std::size_t texel = 0; texel < texels * texels; ++texel)
      REQUIRE(both.ofLeaves.grids[s].elementOfTexel[texel] ==
              leafElement[both.ofTexels.grids[s].elementOfTexel[texel]]);
}

TEST_CASE("elementCentre of a leaf is that of a texel of a coarser grid", "[adaptive]") {
  // Without the stars and diagonals, whose texels merge differently on a coarser grid.
  std::vector<Surface> surfaces = tableOfSurfaces();
  surfaces.resize(5);
  const Scene scene = sceneOf(surfaces);
  for (const int side : {1, 4, 16}) {
    const Discretization leaves =
        discretize(scene, {.texels = texels}, std::vector(surfaces.size(), uniformQuadtree(texels, side)));
    const Discretization coarse = discretize(scene, {.texels = texels / side});
    const std::vector<std::uint32_t> under = reference::elementsUnder(leaves, coarse);
    for (std::uint32_t e = 0; e < coarse.elements.size(); ++e) {
      const Leaf leaf = leafOf(leaves.grids[coarse.elements[e].surface], leaves.elements[under[e]].texel);
      if (std::uint32_t(leaf.row / side * (texels / side) + leaf.column / side) != coarse.elements[e].texel) continue;
      CHECK(glm::distance(elementCentre(scene, leaves, under[e]).position, elementCentre(scene, coarse, e).position) <
            1e-14);
    }
  }
}

TEST_CASE("discretize makes patches of whole leaves, and a larger leaf is a patch of its own", "[adaptive]") {
  const Scene scene = sceneOf(tableOfSurfaces());
  for (const int side : {1, 2, 8, 64}) {
    const Discretization discretization =
        discretize(scene, {.texels = texels, .patch = side}, randomQuadtrees(scene, 2));
    for (const Patch& patch : discretization.patches.list) {
      REQUIRE(!patch.elements.empty());
      for (const std::uint32_t number : patch.elements) {
        const Element& element = discretization.elements[number];
        const Leaf leaf = leafOf(discretization.grids[patch.surface], element.texel);
        REQUIRE((leaf.column >= patch.column && leaf.column + leaf.side <= patch.column + patch.width));
        REQUIRE((leaf.row >= patch.row && leaf.row + leaf.side <= patch.row + patch.height));
        if (leaf.side < side) continue;
        REQUIRE(patch.elements.size() == 1);
        REQUIRE((patch.width == leaf.side && patch.height == leaf.side));
      }
    }
  }
  CHECK_THROWS_AS(discretize(scene, {.texels = texels, .patch = 3}, randomQuadtrees(scene, 2)), raster::InputError);
}

TEST_CASE(
    "rows to leaves are the sums of rows to their texels, for ProjectedFormFactors with shared and unique maps and for "
    "rays",
    "[adaptive]") {
  // Patches of 4 x 4 texels, from leaves of at most that size: they shoot from the same points.
  const Scene scene = furnishedRoom();
  std::vector<Quadtree> trees = randomQuadtrees(scene, 3);
  for (Quadtree& tree : trees)
    for (std::uint16_t& side : tree.leafSide) side = std::min<std::uint16_t>(side, 4);
  const TexelsAndLeaves both(scene, trees, 4);
  const std::vector<std::uint32_t> leafElement = both.leafElements(), itself = themselves(both.ofLeaves);
  REQUIRE(both.ofLeaves.patches.list.size() == both.ofTexels.patches.list.size());
  const auto drawn = [&](const Discretization& discretization, IndexMaps indexMaps) {
    return SceneFormFactors(scene, discretization, layOut(discretization, {.format = "r8g8b8", .indexMaps = indexMaps}),
                            {.resolution = 64, .split = 1});
  };
  SceneFormFactors texelRows = drawn(both.ofTexels, IndexMaps::Shared),
                   leafRows = drawn(both.ofLeaves, IndexMaps::Shared);
  SceneFormFactors uniqueRows = drawn(both.ofLeaves, IndexMaps::Unique);
  const reference::RayRowSettings settings{.rays = 1 << 12};
  reference::RayRows texelRays(scene, both.ofTexels, settings), leafRays(scene, both.ofLeaves, settings);
  for (std::uint32_t number = 0; number < both.ofLeaves.patches.list.size(); number += 7) {
    const Patch &block = both.ofTexels.patches.list[number], &patch = both.ofLeaves.patches.list[number];
    const FormFactorRow row = texelRows.uncorrected().ofPatch(block), sum = leafRows.uncorrected().ofPatch(patch);
    CHECK(sharesOf(sum, itself) == sharesOf(row, leafElement));
    CHECK(sum.elements.size() < row.elements.size());
    CHECK(sharesOf(uniqueRows.uncorrected().ofPatch(patch), itself) == sharesOf(row, leafElement));
    CHECK(sharesOf(leafRays.ofPatch(patch), itself) == sharesOf(texelRays.ofPatch(block), leafElement));
  }
}

TEST_CASE("PatchSubdivision lets a leaf near its receivers shoot from several points, and does not quarter it",
          "[adaptive]") {
  const Scene scene = furnishedRoom();
  const std::vector<Quadtree> trees(scene.surfaces.size(), uniformQuadtree(texels, 8));
  const Discretization unsplit = discretize(scene, {.texels = texels}, trees);
  SceneFormFactors drawn(scene, unsplit, layOut(unsplit, {.format = "r8g8b8"}), {});
  const Patches split = splitAll(unsplit.patches, drawn.splits());
  REQUIRE(split.list.size() == unsplit.patches.list.size());
  int ofSeveralPoints = 0;
  for (const Patch& patch : split.list) {
    CHECK((patch.width == 8 && patch.height == 8 && patch.elements.size() == 1));
    ofSeveralPoints += patch.points > 1 ? 1 : 0;
  }
  CHECK(ofSeveralPoints > 0);
}

TEST_CASE("averageMaps averages maps over leaves by area", "[adaptive]") {
  Scene scene = sceneOf(tableOfSurfaces());
  std::mt19937 random(5);
  scene.images = {{9, 7, {}}};
  for (int i = 0; i < 63; ++i) scene.images[0].pixels.emplace_back(random() % 100, 1, random() % 5);
  scene.materials[0].emissionMap = 0;
  scene.materials[0].emission = glm::dvec3(1);
  const TexelsAndLeaves both(scene, randomQuadtrees(scene, 6), 4);
  const std::vector<std::uint32_t> leafElement = both.leafElements();
  std::vector<glm::dvec3> flux(both.ofLeaves.elements.size());
  for (std::uint32_t e = 0; e < leafElement.size(); ++e)
    flux[leafElement[e]] += both.ofTexels.elements[e].area * both.ofTexels.mappedEmission[e];
  for (std::uint32_t e = 0; e < flux.size(); ++e) {
    const glm::dvec3 found = both.ofLeaves.elements[e].area * both.ofLeaves.mappedEmission[e];
    CHECK(glm::distance(found, flux[e]) < 1e-11 * glm::length(flux[e]));
  }
}

TEST_CASE("trueRadiosity works for leaves", "[adaptive]") {
  // A closed room of one material is a furnace: each element has E / (1 - rho), for any division of its surfaces. The
  // sum of all flux is exact, because each row sums to 1; single elements have random errors, whose mean size over
  // sixteen rooms is that expected. A sum over some 200 elements varies by a tenth, the mean of sixteen by a fortieth.
  const Scene scene = closedCube(glm::dvec3(0.5), glm::dvec3(1));
  double found = 0, expected = 0;
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    std::mt19937 random(seed);
    std::vector<Quadtree> trees;
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) trees.push_back(randomQuadtree(8, random));
    const Discretization discretization = discretize(scene, {.texels = 8, .patch = 2}, trees);
    const reference::TrueRadiosity truth =
        reference::trueRadiosity(scene, discretization, {.samples = 1 << 10, .seed = seed});
    glm::dvec3 flux(0);
    for (std::size_t e = 0; e < truth.radiosity.size(); ++e)
      flux += discretization.elements[e].area * truth.radiosity[e];
    CHECK(flux.x == Approx(6 * 2).epsilon(1e-12));
    const std::vector<glm::dvec3> exact(truth.radiosity.size(), glm::dvec3(2));
    found += reference::errorOf(discretization, truth.radiosity, exact).fluxWeighted;
    expected += truth.error.fluxWeighted;
  }
  CHECK(found == Approx(expected).epsilon(0.1));
}

TEST_CASE("adaptiveDiscretization divides a uniform change uniformly, into leaves within the tolerance", "[adaptive]") {
  // Radiosity 1 + x on the unit square: all light is 1.5. A leaf of side h has the area h^2 and the change h, and is
  // split while h^3 / 1.5 is above the tolerance.
  const Scene scene = unitSquare();
  const auto solve = [&](const Discretization& d) {
    return atMiddles(scene, d, [](const glm::dvec3& point) { return 1 + point.x; });
  };
  for (const int side : {16, 8, 4, 2}) {
    const double h = side / 64.0, tolerance = 1.01 * h * h * h / 1.5;
    const Discretization discretization = adaptiveDiscretization(scene, {.texels = 64}, tolerance, solve);
    CHECK(*discretization.grids[0].quadtree == uniformQuadtree(64, side));
  }
  CHECK(*adaptiveDiscretization(scene, {.texels = 64}, 1e-9, solve).grids[0].quadtree == uniformQuadtree(64, 1));
}

TEST_CASE("adaptiveDiscretization makes leaves along a step as small as texels, and larger ones further away",
          "[adaptive]") {
  // Bright left of x = 29/64, dark right of it. In each round the leaves on both sides of the step differ and are
  // split: two columns of 64 / s leaves, with 3 leaves more for each. From 16 leaves to 16 + 6 (4 + 8 + 16 + 32) = 376
  // of the 4096 texels, plus those from balancing.
  const Scene scene = unitSquare();
  const Discretization discretization = adaptiveDiscretization(scene, {.texels = 64}, 1e-9, [&](const auto& d) {
    return atMiddles(scene, d, [](const glm::dvec3& point) { return point.x < 29 / 64.0 ? 1.0 : 0.0; });
  });
  const Quadtree& tree = *discretization.grids[0].quadtree;
  for (int row = 0; row < 64; ++row) {
    for (const int column : {28, 29}) CHECK(leafAt(tree, column, row).side == 1);
    for (const int column : {0, 63}) CHECK(leafAt(tree, column, row).side >= 8);
  }
  CHECK((leavesOf(tree).size() >= 376 && leavesOf(tree).size() < 2 * 376));
}

TEST_CASE("refined splits a small jump on a large area like a large jump on a small area", "[adaptive]") {
  // Two squares with steps at their middles; a third one has most of the light. Area times step is 1 and 16 * 1/16.
  Scene scene = sceneOf({parallelogram("small", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                         parallelogram("large", {9, 0, 0}, {4, 0, 0}, {0, 4, 0}),
                         parallelogram("bright", {0, 9, 0}, {1, 0, 0}, {0, 1, 0})});
  const auto solve = [&](const Discretization& d) {
    return atMiddles(scene, d, [](const glm::dvec3& p) {
      return p.y > 9 ? 100.0 : p.x > 8 ? (p.x < 11 ? 1 + 1 / 16.0 : 1.0) : (p.x < 0.5 ? 2.0 : 1.0);
    });
  };
  const Discretization discretization = adaptiveDiscretization(scene, {.texels = 64}, 2e-5, solve);
  CHECK(*discretization.grids[0].quadtree == *discretization.grids[1].quadtree);
  CHECK(leavesOf(*discretization.grids[0].quadtree).size() > 64);
  CHECK(*discretization.grids[2].quadtree == uniformQuadtree(64, 16));
}

TEST_CASE("adaptiveDiscretization has 2^n x 2^n texels, with both sides at least as many as asked", "[adaptive]") {
  const Scene scene = sceneOf({parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                               parallelogram("oblong", {0, 0, 2}, {1, 0, 0}, {0, 2.1, 0})});
  const auto sidesOf = [&](const DiscretizationSettings& settings) {
    const auto even = [](const Discretization& each) { return std::vector(each.elements.size(), glm::dvec3(1)); };
    std::vector<int> sides;
    for (const Grid& grid : adaptiveDiscretization(scene, settings, 1e-3, even).grids) {
      CHECK(grid.rows == grid.columns);
      sides.push_back(grid.columns);
    }
    return sides;
  };
  CHECK(sidesOf({.texels = 16}) == std::vector{16, 16});
  CHECK(sidesOf({.texels = 12}) == std::vector{16, 16});
  CHECK(sidesOf({.texels = 1}) == std::vector{1, 1});
  CHECK(sidesOf({.texelSize = 0.25}) == std::vector{4, 16});  // 1 / 0.25 = 4, and 2.1 / 0.25 = 8.4
  CHECK(sidesOf({.texels = 4, .surfaceTexels = {{"oblong", {3, 5}}}}) == std::vector{4, 8});
}

TEST_CASE("adaptiveDiscretization of the Cornell box has a smaller error than twice as many texels", "[adaptive]") {
  // The reference has texels half as large with the same patches and hemicubes, so that only the elements differ. The
  // whole curve: hemitex_adaptive_curve.
  const Scene scene = loadScene(HEMITEX_DATA "/cornell-box.obj");
  const auto solved = [&](const Discretization& discretization) {
    SceneFormFactors drawn(scene, discretization, layOut(discretization, {.format = "r32ui"}),
                           {.resolution = 128, .split = 0.05});
    return solve({.scene = scene,
                  .discretization = discretization,
                  .patches = discretization.patches,
                  .rowOf = drawn.rowOf(),
                  .split = drawn.splits(),
                  .settings = {.residual = 0.01}})
        .radiosity;
  };
  const DiscretizationSettings finest{.texels = 32, .patches = 4};
  const Discretization fine = discretize(scene, finest), uniform = discretize(scene, {.texels = 16, .patches = 4});
  const std::vector<glm::dvec3> truth = solved(fine);
  const auto errorOf = [&](const Discretization& discretization, const std::vector<glm::dvec3>& radiosity) {
    return reference::errorOf(fine, reference::onOtherGrids(discretization, radiosity, fine), truth).fluxWeighted;
  };
  std::vector<glm::dvec3> radiosity;
  const Discretization adaptive =
      adaptiveDiscretization(scene, finest, 1.2e-4, [&](const Discretization& d) { return radiosity = solved(d); });
  CHECK(2 * adaptive.elements.size() < uniform.elements.size());
  CHECK(errorOf(adaptive, radiosity) < errorOf(uniform, solved(uniform)));
}
