// sensitivity: derivatives against finite differences of solutions, and the sums that they satisfy.
#include "radiosity/solver/sensitivity.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "raster/base/parallel.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A box without one wall, with a light and a blocker, of which each element has its own reflectance and emission.
struct Box {
  Scene scene;
  Discretization discretization;
  std::vector<FormFactorRow> rows;
  OutsideFlux outside;

  Box() {
    scene = tests::closedCube({0.7, 0.5, 0.2}, glm::dvec3(0));
    scene.materials.push_back(tests::material("light", glm::dvec3(0.1), {3, 2, 1}));
    scene.surfaces.erase(scene.surfaces.begin() + 3);
    scene.surfaces.push_back(
        tests::quad("light", {{{0.3, 0.9, 0.3}, {0.6, 0.9, 0.3}, {0.6, 0.9, 0.7}, {0.3, 0.9, 0.7}}}, 1));
    scene.surfaces.push_back(
        tests::quad("blocker", {{{0.1, 0.4, 0.1}, {0.1, 0.4, 0.5}, {0.6, 0.4, 0.5}, {0.6, 0.4, 0.1}}}));
    scene = tests::finish(scene);
    scene.outside.sky = {0.5, 1, 2};
    discretization = discretize(scene, {.texels = 3, .patch = 2});
    SceneFormFactors formFactors(scene, discretization, layOut(discretization), {.resolution = 64, .split = 1});
    for (const Patch& patch : discretization.patches.list) rows.push_back(formFactors.uncorrected().ofPatch(patch));
    outside = formFactors.outsideFlux();
    std::vector<glm::dvec3> reflectances, emissions;
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
      const double varied = 1 + 0.1 * std::sqrt(e % 7);
      reflectances.push_back(reflectance(scene, discretization, e) / varied);
      emissions.push_back(emission(scene, discretization, e) * varied);
    }
    discretization.mappedReflectance = std::move(reflectances);
    discretization.mappedEmission = std::move(emissions);
  }
  SolveInput input() const {
    return {.scene = scene,
            .discretization = discretization,
            .patches = discretization.patches,
            .rowOf = [this](const Patch& patch) { return rows[patch.number]; },
            .settings = {.residual = 1e-13},
            .outside = outside};
  }
  /// The target by shooting.
  glm::dvec3 target(std::span<const glm::dvec3> weights) const {
    const Solution solution = solve(input());
    glm::dvec3 sum(0.0);
    for (std::size_t e = 0; e < weights.size(); ++e) sum += weights[e] * solution.radiosity[e];
    return sum;
  }
  std::vector<glm::dvec3> weights() const {
    std::vector<glm::dvec3> values;
    for (std::size_t e = 0; e < discretization.elements.size(); ++e)
      values.push_back({1.0 + static_cast<double>(e % 3), e % 5 == 0 ? -1 : 0.5, e < 4 ? 1 : 0});
    return values;
  }
};

/// The central difference of the target by one value of an element, all bands at a time.
glm::dvec3 differenceBy(Box& box, std::vector<glm::dvec3>& values, std::size_t element,
                        std::span<const glm::dvec3> weights) {
  const double step = 1e-3;
  const glm::dvec3 value = values[element];
  values[element] = value + step;
  const glm::dvec3 above = box.target(weights);
  values[element] = value - step;
  const glm::dvec3 below = box.target(weights);
  values[element] = value;
  return (above - below) / (2 * step);
}

/// The derivatives of one target.
Sensitivity sensitivity(const SolveInput& input, const std::vector<glm::dvec3>& weights) {
  return sensitivities(input, {&weights, 1}).front();
}

void checkNear(const glm::dvec3& found, const glm::dvec3& expected, double tolerance) {
  for (int band = 0; band < 3; ++band) {
    INFO("band " << band << ": " << found[band] << ", " << expected[band]);
    CHECK(std::abs(found[band] - expected[band]) <= tolerance * std::abs(expected[band]));
  }
}

}  // namespace

TEST_CASE("sensitivity equals finite differences of solutions to 1e-6", "[solver]") {
  Box box;
  const std::vector<glm::dvec3> weights = box.weights();
  const Sensitivity result = sensitivity(box.input(), weights);
  checkNear(result.target, box.target(weights), 1e-11);
  for (std::size_t element = 0; element < weights.size(); element += 5) {
    INFO("element " << element);
    checkNear(result.byEmission[element], differenceBy(box, box.discretization.mappedEmission, element, weights), 1e-6);
    checkNear(result.byReflectance[element], differenceBy(box, box.discretization.mappedReflectance, element, weights),
              1e-6);
  }
}

TEST_CASE("sensitivity: emissions times derivatives sum to the target", "[solver]") {
  Box box;
  box.outside = {};
  const std::vector<glm::dvec3> weights = box.weights();
  const Sensitivity result = sensitivity(box.input(), weights);
  glm::dvec3 sum(0.0), weighted(0.0);
  for (std::uint32_t e = 0; e < weights.size(); ++e) {
    sum += emission(box.scene, box.discretization, e) * result.byEmission[e];
    weighted += weights[e] * result.radiosity[e];
  }
  checkNear(sum, result.target, 1e-12);
  checkNear(weighted, result.target, 1e-12);
}

TEST_CASE("sensitivity in a furnace has the derivatives of E / (1 - rho)", "[solver]") {
  const double rho = 0.6, emitted = 2;
  const Scene scene = tests::closedCube(glm::dvec3(rho), glm::dvec3(emitted));
  const Discretization discretization = discretize(scene, {.texels = 2, .patch = 1});
  SceneFormFactors formFactors(scene, discretization, layOut(discretization), {.resolution = 64, .split = 1});
  const std::vector<glm::dvec3> mean(discretization.elements.size(),
                                     glm::dvec3(1.0 / static_cast<double>(discretization.elements.size())));
  const Sensitivity result =
      sensitivity({.scene = scene,
                   .discretization = discretization,
                   .patches = discretization.patches,
                   .rowOf = [&](const Patch& from) { return formFactors.uncorrected().ofPatch(from); }},
                  mean);
  glm::dvec3 byEmission(0.0), byReflectance(0.0);
  for (const glm::dvec3& value : result.byEmission) byEmission += value;
  for (const glm::dvec3& value : result.byReflectance) byReflectance += value;
  checkNear(byEmission, glm::dvec3(1 / (1 - rho)), 1e-12);
  checkNear(result.target, glm::dvec3(emitted / (1 - rho)), 1e-12);
  checkNear(byReflectance, glm::dvec3(emitted / ((1 - rho) * (1 - rho))), 1e-12);
}

TEST_CASE("sensitivity does not depend on the number of threads", "[solver]") {
  const Box box;
  const std::vector<glm::dvec3> weights = box.weights();
  const Sensitivity all = sensitivity(box.input(), weights);
  const raster::ThreadLimit one(1);
  const Sensitivity alone = sensitivity(box.input(), weights);
  CHECK(all.byEmission == alone.byEmission);
  CHECK(all.byReflectance == alone.byReflectance);
}

TEST_CASE("sensitivities of several targets are those of each alone, from the rows of one", "[solver]") {
  const Box box;
  std::vector<std::vector<glm::dvec3>> targets(3, box.weights());
  for (glm::dvec3& weight : targets[1]) weight *= -2.0;
  targets[2].assign(targets[2].size(), glm::dvec3(1));
  const SolveInput input = box.input();
  std::size_t rows = 0;
  SolveInput counted = input;
  counted.rowOf = [&](const Patch& from) {
    ++rows;
    return input.rowOf(from);
  };
  const std::vector<Sensitivity> all = sensitivities(counted, targets);
  CHECK(rows == input.patches.list.size());
  REQUIRE(all.size() == targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const Sensitivity alone = sensitivity(input, targets[t]);
    CHECK(all[t].target == alone.target);
    CHECK(all[t].byEmission == alone.byEmission);
    CHECK(all[t].byReflectance == alone.byReflectance);
    CHECK(all[t].radiosity == alone.radiosity);
  }
}
