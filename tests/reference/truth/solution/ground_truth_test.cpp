// trueRadiosity of scenes with known solutions.
#include "reference/truth/solution/ground_truth.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "tests/support/hand_scenes.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::reference;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

TrueRadiosity truthOf(const Scene& scene, int texels, const Sampling& sampling) {
  return trueRadiosity(scene, discretize(scene, {.texels = texels}), sampling);
}

/// Unit squares at a gap of 1 that face each other; the lower one emits 1, 2 and 4, and both reflect.
Scene twoSquares() {
  Scene scene = tests::sceneOf({tests::quad("lower", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}),
                                tests::quad("upper", {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}, 1)});
  scene.materials = {tests::material("light", {0.5, 0.25, 0}, {1, 2, 4}),
                     tests::material("grey", {0.75, 0.5, 0.25}, glm::dvec3(0))};
  return scene;
}

}  // namespace

TEST_CASE("trueRadiosity of a furnace is E over 1 minus r, within its expected error", "[truth]") {
  // A closed cube in which all surfaces emit E and reflect r has the radiosity B = E + r B everywhere. Each ray arrives
  // at an element, so that the total flux is exact for any number of rays; its distribution is not.
  const Scene scene = tests::closedCube(glm::dvec3(0.25, 0.5, 0.75), glm::dvec3(1, 2, 3));
  const Discretization discretization = discretize(scene, {.texels = 4});
  const TrueRadiosity truth = trueRadiosity(scene, discretization, {1 << 12});
  const std::vector<glm::dvec3> exact(truth.radiosity.size(), glm::dvec3(1 / 0.75, 2 / 0.5, 3 / 0.25));
  const RadiosityError error = errorOf(discretization, truth.radiosity, exact);
  glm::dvec3 flux(0);
  for (std::size_t e = 0; e < exact.size(); ++e) flux += discretization.elements[e].area * truth.radiosity[e];
  for (int band = 0; band < 3; ++band) CHECK(flux[band] == Approx(6 * exact[0][band]).epsilon(1e-12));
  // Two means of 96 absolute errors agree within a factor of 1.5. Light reflected again is uniform and adds little.
  CHECK(error.fluxWeighted > 0);
  CHECK(error.fluxWeighted < 1.5 * truth.error.fluxWeighted);
  CHECK(error.fluxWeighted > truth.error.fluxWeighted / 1.5);
}

TEST_CASE("trueRadiosity of two squares is their closed form", "[truth]") {
  // B1 = E + r1 F B2 and B2 = r2 F B1, for undivided squares: B1 = E / (1 - r1 r2 F^2).
  const AxisRectangle square{{0, 1}, {0, 1}};
  const double factor = parallelRectangles(square, square, 1);
  const glm::dvec3 emission(1, 2, 4), r1(0.5, 0.25, 0), r2(0.75, 0.5, 0.25);
  const TrueRadiosity truth = truthOf(twoSquares(), 1, {1 << 16});
  for (int band = 0; band < 3; ++band) {
    const double lower = emission[band] / (1 - r1[band] * r2[band] * factor * factor);
    // The hemisphere's standard error with 2^16 rays is below 1e-3 of a form factor of 0.2.
    CHECK(truth.radiosity[0][band] == Approx(lower).epsilon(1e-3));
    CHECK(truth.radiosity[1][band] == Approx(r2[band] * factor * lower).epsilon(4e-3));
  }
}

TEST_CASE("trueRadiosity with sixteen times the samples expects at most a fourth of the error", "[truth]") {
  const Scene scene = twoSquares();
  const double few = truthOf(scene, 4, {1 << 11}).error.fluxWeighted;
  const double many = truthOf(scene, 4, {1 << 15}).error.fluxWeighted;
  CHECK(many < few / 3);
}

TEST_CASE("trueRadiosity expects the error found with other seeds, and the spread that of the matrix", "[truth]") {
  // Two independent results differ by root 2 times the error of each, on average. With an uneven distribution of flux
  // (the upper square emits nothing), the emitter's rays determine the error.
  constexpr std::uint32_t pairs = 32;
  const Discretization discretization = discretize(twoSquares(), {.texels = 6});
  double found = 0, expected = 0, squares = 0, foundSquares = 0, expectedSquares = 0;
  for (std::uint32_t pair = 0; pair < pairs; ++pair) {
    const TrueRadiosity one = truthOf(twoSquares(), 6, {1 << 10, 2 * pair}),
                        other = truthOf(twoSquares(), 6, {1 << 10, 2 * pair + 1});
    const double differs = errorOf(discretization, one.radiosity, other.radiosity).fluxWeighted / std::sqrt(2.0);
    const double error = (one.error.fluxWeighted + other.error.fluxWeighted) / 2;
    found += differs;
    expected += error;
    squares += (differs - error) * (differs - error);
    for (std::size_t i = 0; i < one.matrix.factors.size(); ++i) {
      foundSquares += std::pow(one.matrix.factors[i] - other.matrix.factors[i], 2);
      expectedSquares += std::pow(one.spread.factors[i], 2) + std::pow(other.spread.factors[i], 2);
    }
  }
  // The standard error of the sum of the pairs, and 2 % for light that is reflected again.
  CHECK(std::sqrt(squares) < 0.05 * expected);
  CHECK(std::abs(found - expected) < 3 * std::sqrt(squares) + 0.02 * expected);
  // Root mean squares over about 83,000 pairs of elements that see each other.
  CHECK(std::sqrt(foundSquares) == Approx(std::sqrt(expectedSquares)).epsilon(0.02));
}

TEST_CASE("trueRadiosity gives the same bits for any number of threads, and other bits for other seeds", "[truth]") {
  const Scene scene = twoSquares();
  const auto radiosity = [&](int threads, std::uint32_t seed) {
    const raster::ThreadLimit limit(threads);
    return truthOf(scene, 3, {1 << 8, seed}).radiosity;
  };
  const std::vector<glm::dvec3> one = radiosity(1, 0);
  CHECK(radiosity(3, 0) == one);
  CHECK(radiosity(1, 1) != one);
}

TEST_CASE("trueRadiosity throws InputError with advice for more than 5000 elements", "[truth]") {
  // Two squares of 51 x 51 texels have 5202 elements.
  CHECK_THROWS_WITH(truthOf(twoSquares(), 51, {64}),
                    Catch::Contains("5202 elements") && Catch::Contains("use fewer texels"));
}
