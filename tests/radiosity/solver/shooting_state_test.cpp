// ShootingState: continues from stored shots, and retracts excess light.
#include "radiosity/solver/shooting_state.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/row_cache.h"
#include "tests/support/box_scene.h"
#include "tests/support/hemicube_world.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Shoots `shots` times, or until less than a residual is left.
void shoot(ShootingState& state, const RowSource& rowOf, int shots, double residual = 0) {
  for (int shot = 0; shot < shots && state.residual() > residual; ++shot) {
    const std::uint32_t patch = state.brightestPatch();
    state.shoot(patch, rowOf(state.patches().list[patch]));
  }
}

/// Rows, each drawn once.
RowSource rowsOf(ProjectedFormFactors& rows, RowCache& cache) {
  return [&](const Patch& patch) { return cache.row(patch.number, [&] { return rows.ofPatch(patch); }); };
}

/// The state before the first shot.
ShootingState unlit(const Scene& scene, const Discretization& discretization, OutsideFlux outside = {}) {
  const Patches& patches = discretization.patches;
  return {scene, discretization, patches, nothingShot(patches, 3, std::move(outside))};
}

Scene litCube(const glm::dvec3& emission) {
  Scene scene = tests::closedCube({0.7, 0.5, 0.2}, glm::dvec3(0));
  scene.materials.push_back(tests::material("light", glm::dvec3(0.4), emission));
  scene.surfaces[3].material = 1;
  return scene;
}

}  // namespace

TEST_CASE("ShootingState made from stored shots continues as if it had not been interrupted", "[refinement]") {
  // Patches of one element receive per element, patches of four as a whole, except with different reflectances.
  for (const auto& [patch, isMapped] : {std::pair(1, false), {2, false}, {2, true}}) {
    tests::HemicubeWorld world(litCube({3, 2, 1}), 4, patch);
    if (isMapped)
      for (std::size_t e = 0; e < world.discretization.elements.size(); ++e)
        world.discretization.mappedReflectance.push_back(glm::dvec3(0.1, 0.2, 0.3) * static_cast<double>(e % 4));
    ProjectedFormFactors rows = world.rows(32);
    RowCache cache(std::size_t{1} << 30);
    const RowSource rowOf = rowsOf(rows, cache);
    ShootingState whole = unlit(world.scene, world.discretization);
    shoot(whole, rowOf, 20);
    ShootingState continued(world.scene, world.discretization, world.discretization.patches, whole.light());
    // The same sums in another order: a few units in the last place of the largest patch's flux.
    CHECK(continued.residual() == Approx(whole.residual()).epsilon(1e-12));
    const Energy energy = whole.energy();
    for (std::size_t band = 0; band < 3; ++band)
      CHECK(energy.absorbed[band] + energy.unshot[band] + energy.lost[band] ==
            Approx(energy.emitted[band]).epsilon(1e-12));
    shoot(whole, rowOf, 20);
    shoot(continued, rowOf, 20);
    const BandTable found = std::move(continued).radiosity(), expected = std::move(whole).radiosity();
    REQUIRE(found.size() == world.discretization.elements.size());
    for (std::size_t i = 0; i < found.values.size(); ++i)
      CHECK(found.values[i] == Approx(expected.values[i]).epsilon(1e-12));
  }
}

TEST_CASE("ShootingState: seenResidual of all surfaces is the residual, and seenGain is what a shot adds",
          "[refinement]") {
  tests::HemicubeWorld world(litCube({3, 2, 1}), 4, 2);
  ProjectedFormFactors rows = world.rows(32);
  RowCache cache(std::size_t{1} << 30);
  const RowSource rowOf = rowsOf(rows, cache);
  ShootingState state = unlit(world.scene, world.discretization);
  const std::vector<bool> all(6, true), none(6, false);
  for (int shot = 0; shot < 30; ++shot) {
    const std::uint32_t patch = state.brightestPatch();
    const FormFactorRow row = rowOf(state.patches().list[patch]);
    const double before = bandSum(state.energy().absorbed);
    state.setSeen(none);
    CHECK(state.seenGain(patch, row) == 0);
    CHECK(state.seenResidual() == 0);
    CHECK(std::isinf(state.seenShare()));
    state.setSeen(all);
    const double gain = state.seenGain(patch, row);
    state.shoot(patch, row);
    const Energy energy = state.energy();
    const double absorbed = bandSum(energy.absorbed);
    CHECK(gain == Approx((absorbed - before) / absorbed).epsilon(1e-10));
    CHECK(state.seenShare() == Approx(absorbed / bandSum(energy.emitted)).epsilon(1e-10));
    const double residual = state.seenResidual();
    CHECK(residual == Approx(state.residual() * bandSum(energy.emitted) / absorbed).epsilon(1e-10));
    // What follows the shots has the bits of a sum over all elements.
    state.setSeen(all);
    CHECK(state.seenResidual() == residual);
    state.setSeen({});
    CHECK(state.seenResidual() == 0);
  }
}

TEST_CASE("ShootingState counts light from outside as emitted, and its account closes", "[refinement]") {
  Scene open = litCube({3, 2, 1});
  open.surfaces.pop_back();
  open.outside = {{4, 5, 6}, {{glm::normalize(glm::dvec3(0.1, 0.2, 1)), {7, 8, 9}}}};
  tests::HemicubeWorld world(std::move(open), 4, 2);
  ProjectedFormFactors rows = world.rows(32);
  RowCache cache(std::size_t{1} << 30);
  const RowSource rowOf = rowsOf(rows, cache);
  const OutsideFlux outside =
      outsideFlux(world.scene, world.discretization, world.layout, world.renderer, {.directions = 64});
  const Bands entered = sumOf(outside);
  ShootingState state = unlit(world.scene, world.discretization, outside);
  CHECK(state.residual() > 0.5);
  for (const int shots : {0, 1, 50}) {
    shoot(state, rowOf, shots);
    const Energy energy = state.energy();
    CHECK(energy.emitted[0] == Approx(3 + entered[0]).epsilon(1e-12));
    CHECK(energy.skyOnBacks == outside.onBacks);
    for (std::size_t band = 0; band < 3; ++band)
      CHECK(energy.absorbed[band] + energy.unshot[band] + energy.lost[band] ==
            Approx(energy.emitted[band]).epsilon(1e-12));
  }
  // Without reflectance the radiosity is the emission: what comes from outside is received, not emitted again.
  Scene black = world.scene;
  for (Material& material : black.materials) material.reflectance = glm::dvec3(0);
  ShootingState absorbing = unlit(black, world.discretization, outside);
  CHECK(absorbing.energy().unshot[0] == Approx(3));
  CHECK(absorbing.energy().absorbed[1] == Approx(entered[1]).epsilon(1e-12));
  CHECK(areZero(std::move(absorbing).radiosity()[0]));
  // Continued from its light, the state is the same.
  const ShootingState continued(world.scene, world.discretization, world.discretization.patches, state.light());
  CHECK(continued.residual() == Approx(state.residual()).epsilon(1e-12));
  CHECK(continued.energy().emitted == state.energy().emitted);
}

TEST_CASE("ShootingState retracts a light that was switched off by negative shots, and the account closes",
          "[refinement]") {
  tests::HemicubeWorld world(litCube({3, 2, 1}), 4, 2);
  const Scene dark = litCube(glm::dvec3(0));
  ProjectedFormFactors rows = world.rows(32);
  RowCache cache(std::size_t{1} << 30);
  const RowSource rowOf = rowsOf(rows, cache);
  ShootingState lit = unlit(world.scene, world.discretization);
  shoot(lit, rowOf, 100000, 1e-4);
  ShootingState state(dark, world.discretization, world.discretization.patches, lit.light());
  // The side of area 1 emitted 6 W, all of which was shot.
  CHECK(state.residual() >= 1 - 1e-4);
  shoot(state, rowOf, 100000, 1e-6);
  CHECK(state.residual() <= 1e-6);
  const Energy energy = state.energy();
  CHECK(areZero(energy.emitted));
  for (std::size_t band = 0; band < 3; ++band)
    CHECK(std::abs(energy.absorbed[band] + energy.unshot[band] + energy.lost[band]) <= 1e-12);
  // In the end nothing is received, and the residual bounds the absorbed flux until then.
  double absorbed = 0;
  for (std::size_t e = 0; e < world.discretization.elements.size(); ++e) {
    const glm::dvec3 reflects = reflectance(dark, world.discretization, static_cast<std::uint32_t>(e));
    for (int band = 0; band < 3; ++band)
      absorbed += (1 - reflects[band]) * std::abs(state.light().received[e][static_cast<std::size_t>(band)]);
  }
  CHECK(absorbed <= 1e-6 * 6);
}

TEST_CASE("ShootingState bounds the absorbed flux still to come by the residual", "[refinement]") {
  tests::HemicubeWorld world(litCube({3, 2, 1}), 4, 2);
  ProjectedFormFactors rows = world.rows(32);
  RowCache cache(std::size_t{1} << 30);
  const RowSource rowOf = rowsOf(rows, cache);
  ShootingState end = unlit(world.scene, world.discretization);
  shoot(end, rowOf, 100000, 1e-12);
  ShootingState state = unlit(world.scene, world.discretization);
  for (int step = 0; step < 40; ++step) {
    shoot(state, rowOf, 3);
    double difference = 0;
    for (std::size_t e = 0; e < world.discretization.elements.size(); ++e) {
      const glm::dvec3 reflects = reflectance(world.scene, world.discretization, static_cast<std::uint32_t>(e));
      for (int band = 0; band < 3; ++band)
        difference += (1 - reflects[band]) * std::abs(end.light().received[e][static_cast<std::size_t>(band)] -
                                                      state.light().received[e][static_cast<std::size_t>(band)]);
    }
    CHECK(difference <= (state.residual() + 2e-12) * 6);
    CHECK(difference > 0);
  }
}

TEST_CASE("ShootingState::shoot visits the entries of its row, not all elements or patches", "[refinement]") {
  const Scene scene = litCube({3, 2, 1});
  const Discretization discretization = discretize(scene, {.texels = 410, .patch = 4});
  REQUIRE(discretization.elements.size() == 1008600);
  REQUIRE(discretization.patches.list.size() == 63654);
  FormFactorRow row{{5, 1000, 200000, 300000, 400000, 500000, 600000, 700000, 800000, 900000}, {}};
  row.shares.assign(10, wholeShare / 16);
  row.background = wholeShare - 10 * (wholeShare / 16);
  ShootingState state = unlit(scene, discretization);
  // Ten elements receive. They and the shooter lie in at most eleven blocks of 64 patches. These have eleven parent
  // nodes of 64 blocks, and the root has 16 children.
  for (int shot = 0; shot < 1000; ++shot) REQUIRE(state.shoot(state.brightestPatch(), row) <= 10 + 11 * (64 + 64) + 16);
}

TEST_CASE("ShootingState::shoot visits the patches of a surface at most once per two receiving elements",
          "[refinement]") {
  const Scene scene = litCube({3, 2, 1});
  const Discretization discretization = discretize(scene, {.texels = 64, .patch = 2});
  const Grid& grid = discretization.grids[0];
  REQUIRE(grid.patchCount == 1024);
  // The smallest number of visible elements for this, and one less.
  for (const std::uint32_t seen : {2048U, 2047U}) {
    FormFactorRow row;
    for (std::uint32_t e = 0; e < seen; ++e) row.elements.push_back(grid.firstElement + e);
    row.shares.assign(seen, wholeShare / 4096);
    row.background = wholeShare - seen * (wholeShare / 4096);
    ShootingState state = unlit(scene, discretization);
    const std::size_t visits = state.shoot(state.brightestPatch(), row);
    // 2048 elements lie in 512 patches, these in eight blocks, the shooter in another; the root has 96 descendants.
    const std::size_t updated = (8 + 1) * 64 + 2 * (64 + 64) + 2;
    INFO(seen << " elements: " << visits);
    CHECK(visits >= seen + (seen == 2048 ? grid.patchCount : 0));
    CHECK(visits <= seen + (seen == 2048 ? grid.patchCount : 0) + updated);
    // Received flux is partly unshot and partly absorbed, in all sums.
    const Energy energy = state.energy();
    const double arrived = static_cast<double>(seen) / 4096 * energy.emitted[0] / static_cast<double>(grid.patchCount);
    CHECK(energy.absorbed[0] == Approx((1 - 0.7) * arrived).epsilon(1e-12));
    CHECK(energy.emitted[0] - energy.unshot[0] == Approx(0.3 * arrived + energy.lost[0]).epsilon(1e-12));
  }
}
