// RayFormFactors compared with closed forms: both estimators, with and without blockers, and their standard errors.
#include "reference/truth/rays/monte_carlo_form_factors.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/receivers.h"
#include "tests/truth/rectangles.h"

using namespace hemitex;
using namespace hemitex::reference;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

struct DiscreteWorld {
  Scene scene;
  Discretization discretization;
  RayFormFactors rays;

  explicit DiscreteWorld(Scene s, int texels = 1, int patch = 4)
      : scene(std::move(s)),
        discretization(discretize(scene, {.texels = texels, .patch = patch})),
        rays(scene, discretization) {}

  RaySource surface(std::uint32_t number) const {
    return areaRaySource(rays.pieces(), elementsOfSurface(discretization, number));
  }
  RaySource element(std::uint32_t number) const { return areaRaySource(rays.pieces(), std::vector{number}); }
};

/// The rectangle `to` in the plane z = gap, facing down, its chart's columns along y and rows along x.
Surface facingDown(const AxisRectangle& to, double gap) {
  return tests::parallelogram("over", {to.first.low, to.second.low, gap}, {0, to.second.high - to.second.low, 0},
                              {to.first.high - to.first.low, 0, 0});
}
/// The rectangle `from` in the plane z = 0, facing up.
Surface facingUp(const AxisRectangle& from) {
  return tests::parallelogram("under", {from.first.low, from.second.low, 0}, {from.first.high - from.first.low, 0, 0},
                              {0, from.second.high - from.second.low, 0});
}
/// The rectangle `to` (x, z) in the plane y = 0, facing along y.
Surface facingAlongY(const AxisRectangle& to) {
  return tests::parallelogram("wall", {to.first.low, 0, to.second.low}, {0, 0, to.second.high - to.second.low},
                              {to.first.high - to.first.low, 0, 0});
}

const AxisRectangle unitSquare{{0, 1}, {0, 1}};

/// A form factor from the first surface of a scene to the second that is known in closed form.
struct Case {
  std::string name;
  std::vector<Surface> surfaces;
  double exact;
  double unhidden;       ///< without the blocker
  bool isClose = false;  ///< a gap under a tenth of the side
};

Case unblocked(const std::string& name, const Surface& from, const Surface& to, double exact, bool isClose = false) {
  return {name, {from, to}, exact, exact, isClose};
}

/// Unit squares at a gap and, halfway, a blocker of zero thickness over `covered`. A line between the squares passes
/// the middle plane at the mean of its ends, whose distribution is symmetric in x and in y. So a blocker over all x <
/// 1/2 hides exactly half, and one over x, y < 1/2 a quarter.
Case blocked(const std::string& name, double gap, const AxisRectangle& covered, double share) {
  return {name + " at a gap of " + std::to_string(gap),
          {facingUp(unitSquare), facingDown(unitSquare, gap), facingDown(covered, gap / 2)},
          (1 - share) * parallelRectangles(unitSquare, unitSquare, gap),
          parallelRectangles(unitSquare, unitSquare, gap),
          gap < 0.1};
}

std::vector<Case> tableOfCases() {
  std::vector<Case> cases;
  for (const double gap : {10.0, 1.0, 0.3, 0.1, 0.03, 0.001})
    cases.push_back(unblocked("parallel squares at a gap of " + std::to_string(gap), facingUp(unitSquare),
                              facingDown(unitSquare, gap), parallelRectangles(unitSquare, unitSquare, gap), gap < 0.1));
  const AxisRectangle aside{{1.5, 4}, {-1, 0.25}}, small{{0.4, 0.45}, {0.6, 0.7}};
  cases.push_back(unblocked("parallel, aside", facingUp(unitSquare), facingDown(aside, 0.5),
                            parallelRectangles(unitSquare, aside, 0.5)));
  cases.push_back(unblocked("parallel, to a small one", facingUp(unitSquare), facingDown(small, 0.2),
                            parallelRectangles(unitSquare, small, 0.2)));
  cases.push_back(unblocked("parallel, from a small one", facingUp(small), facingDown(unitSquare, 0.2),
                            parallelRectangles(small, unitSquare, 0.2)));
  for (const AxisRectangle& wall :
       {AxisRectangle{{0, 1}, {0, 1}}, {{0, 1}, {0, 0.1}}, {{-1, 2}, {0.5, 2}}, {{1, 1.2}, {0, 3}}})
    for (const double gap : {0.0, 0.02, 0.5}) {
      const AxisRectangle floor{{0, 1}, {gap, gap + 1}};
      cases.push_back(
          unblocked("perpendicular", facingUp(floor), facingAlongY(wall), perpendicularRectangles(floor, wall)));
    }
  for (const double gap : {1.0, 0.3, 0.05}) {
    cases.push_back(blocked("nothing hidden", gap, {{1.1, 1.2}, {0, 1}}, 0));
    cases.push_back(blocked("half hidden", gap, {{-1, 0.5}, {-1, 2}}, 0.5));
    cases.push_back(blocked("a quarter hidden", gap, {{-1, 0.5}, {-1, 0.5}}, 0.25));
    cases.push_back(blocked("all hidden", gap, {{-1, 2}, {-1, 2}}, 1));
  }
  return cases;
}

using Estimator = MeasuredRow (RayFormFactors::*)(const RaySource&, const Receivers&, const Sampling&) const;
constexpr Estimator bothEstimators[] = {&RayFormFactors::overHemisphere, &RayFormFactors::aimed};

Measurement measured(const Case& example, Estimator estimator, const Sampling& sampling) {
  const DiscreteWorld world(tests::sceneOf(example.surfaces));
  return (world.rays.*estimator)(world.surface(0), tests::onlyElement(world.discretization, 1), sampling).receivers[0];
}

/// Errors are 31 % to 86 % of standard errors on average (see sample_points.h), so that three standard errors are at
/// least 3.5 standard deviations.
bool agrees(const Measurement& estimate, double exact) {
  return std::abs(estimate.value - exact) <= 3 * estimate.standardError + 1e-9;
}

bool sameBits(const MeasuredRow& a, const MeasuredRow& b) {
  const auto same = [](const Measurement& x, const Measurement& y) {
    return x.value == y.value && x.standardError == y.standardError;
  };
  return std::equal(a.receivers.begin(), a.receivers.end(), b.receivers.begin(), b.receivers.end(), same) &&
         same(a.back, b.back) && same(a.background, b.background);
}

}  // namespace

TEST_CASE("RayFormFactors agree with closed forms within their standard errors", "[ray form factors]") {
  for (const Case& example : tableOfCases())
    for (const Estimator estimator : bothEstimators) {
      const Measurement estimate = measured(example, estimator, {1 << 13});
      INFO(example.name << ": " << estimate.value << " +- " << estimate.standardError << ", exact " << example.exact);
      CHECK(agrees(estimate, example.exact));
    }
}

TEST_CASE("RayFormFactors agree with closed forms from each element to each element", "[ray form factors]") {
  // 5 x 5 elements on each of two squares: 1250 values per estimator. The standard deviations are from 32 values, so
  // 4e-4 of normal errors are beyond 4 of those. The smallest factor, 0.002, still gets 30 rays.
  constexpr int n = 5;
  const auto part = [](int i) { return Interval{double(i) / n, double(i + 1) / n}; };
  const DiscreteWorld parallel(tests::sceneOf({facingUp(unitSquare), facingDown(unitSquare, 0.4)}), n);
  const DiscreteWorld perpendicular(tests::sceneOf({facingUp(unitSquare), facingAlongY(unitSquare)}), n);
  for (const Estimator estimator : bothEstimators) {
    const int samples = estimator == &RayFormFactors::aimed ? 1 << 10 : 1 << 14;
    int beyond = 0;
    for (std::uint32_t from = 0; from < n * n; ++from) {
      const AxisRectangle raySource{part(int(from) % n), part(int(from) / n)};
      const auto rowOf = [&](const DiscreteWorld& world) {
        return (world.rays.*estimator)(world.element(from), everyElement(world.discretization), {samples, from});
      };
      const MeasuredRow over = rowOf(parallel), beside = rowOf(perpendicular);
      for (int to = 0; to < n * n; ++to) {
        const AxisRectangle receiver{part(to / n), part(to % n)};
        const auto column = static_cast<std::size_t>(n * n + to);
        beyond += !agrees(over.receivers[column], parallelRectangles(raySource, receiver, 0.4));
        beyond += !agrees(beside.receivers[column], perpendicularRectangles(raySource, receiver));
      }
    }
    CHECK(beyond <= 2);  // 0.2 % of 1250
  }
}

namespace {

/// Root mean squares over seeds: of the errors, and of their standard errors.
struct Spread {
  double error, standardError;
};

/// `texels` is the number per side of the source.
Spread spreadOf(const Case& example, Estimator estimator, int samples, std::uint32_t seeds, int texels = 1) {
  const DiscreteWorld world(tests::sceneOf(example.surfaces));
  const RaySource source = DiscreteWorld(tests::sceneOf(example.surfaces), texels).surface(0);
  const Receivers receivers = tests::onlyElement(world.discretization, 1);
  double errors = 0, variance = 0;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const Measurement estimate = (world.rays.*estimator)(source, receivers, {samples, seed}).receivers[0];
    errors += (estimate.value - example.exact) * (estimate.value - example.exact);
    variance += estimate.standardError * estimate.standardError;
  }
  return {std::sqrt(errors / seeds), std::sqrt(variance / seeds)};
}

Case opposing() {
  return unblocked("opposing unit squares", facingUp(unitSquare), facingDown(unitSquare, 1),
                   parallelRectangles(unitSquare, unitSquare, 1));
}

}  // namespace

TEST_CASE("RayFormFactors give standard errors that are not below the errors", "[ray form factors]") {
  // Over 150 seeds the mean square of normal errors has a relative deviation of sqrt(2 / 150). The test allows four of
  // those. Blocks of the sequence complement each other, so that standard errors may be larger than errors.
  constexpr int seeds = 150;
  const double most = std::sqrt(1 + 4 * std::sqrt(2.0 / seeds)), least = std::sqrt(1 - 4 * std::sqrt(2.0 / seeds));
  const std::vector<Case> cases{opposing(),
                                unblocked("perpendicular", facingUp(unitSquare), facingAlongY(unitSquare),
                                          perpendicularRectangles(unitSquare, unitSquare)),
                                blocked("half hidden", 0.3, {{-1, 0.5}, {-1, 2}}, 0.5)};
  for (const Case& example : cases)
    for (const Estimator estimator : bothEstimators) {
      const Spread spread = spreadOf(example, estimator, 1 << 11, seeds);
      INFO(example.name << ": errors " << spread.error << ", standard errors " << spread.standardError);
      CHECK(spread.error < most * spread.standardError);
      if (estimator == &RayFormFactors::overHemisphere) CHECK(spread.error > 0.4 * spread.standardError);
    }
  // The rays that meet a small receiver are few, and random.
  const AxisRectangle tiny{{0.4, 0.44}, {0.6, 0.64}};
  const Spread spread = spreadOf(
      unblocked("tiny", facingUp(unitSquare), facingDown(tiny, 0.7), parallelRectangles(unitSquare, tiny, 0.7)),
      &RayFormFactors::overHemisphere, 1 << 14, seeds);
  INFO("errors " << spread.error << ", standard errors " << spread.standardError);
  CHECK(spread.error < most * spread.standardError);
  CHECK(spread.error > least * spread.standardError);
}

TEST_CASE("RayFormFactors over the hemisphere have a fifth of the error of random rays, for any number of texels",
          "[ray form factors]") {
  // The standard deviation of random rays is sqrt(F (1 - F) / samples), 1.56e-3. Points over a hemisphere and an area
  // have four coordinates. An indicator function of four has errors proportional to samples^(-5/8), 8 times smaller
  // than random at 2^16 except for a constant (He and Wang, On the convergence rate of randomized quasi-Monte Carlo for
  // discontinuous functions, 2015). Over 40 seeds, the measured root mean square has a deviation of 11 %. The fifth is
  // three deviations above the value, 2.2e-4. Points over texels in row order had 5.9e-4 with one texel, and 4.9e-4
  // with 16 x 16.
  const double random = std::sqrt(opposing().exact * (1 - opposing().exact) / (1 << 16));
  for (const int texels : {1, 16}) {
    const Spread spread = spreadOf(opposing(), &RayFormFactors::overHemisphere, 1 << 16, 40, texels);
    INFO(texels << " texels: " << spread.error);
    CHECK(spread.error < random / 5);
  }
}

TEST_CASE("RayFormFactors of aimed rays without blockers have errors of 1e-9, for any number of texels",
          "[ray form factors]") {
  // Only the smooth average over the source is sampled. Errors of symmetric points cancel, so that ten times the error
  // of the closed forms, 1e-10, is left. Points over texels in row order had 1.4e-6 with one texel, and 1.1e-5 with 16
  // x 16.
  for (const int texels : {1, 16}) {
    const Spread spread = spreadOf(opposing(), &RayFormFactors::aimed, 1 << 16, 10, texels);
    INFO(texels << " texels: " << spread.error);
    CHECK(spread.error < 1e-9);
  }
}

TEST_CASE("RayFormFactors with more samples have smaller errors", "[ray form factors]") {
  // Sixteen times the samples divide a random error by 4, errors over the hemisphere by 16^(5/8) = 5.7 and smooth ones
  // by at least 16. Measured root mean squares over 40 seeds have deviations of 11 %, their ratio of 16 %.
  const auto gain = [&](Estimator estimator) {
    return spreadOf(opposing(), estimator, 1 << 11, 40).error / spreadOf(opposing(), estimator, 1 << 15, 40).error;
  };
  CHECK(gain(&RayFormFactors::overHemisphere) > 4);
  CHECK(gain(&RayFormFactors::aimed) > 16);
}

TEST_CASE(
    "RayFormFactors with a million samples have errors of 2e-4 over the hemisphere, and 1e-4 of the value with aimed "
    "rays",
    "[.full]") {
  // The error over the hemisphere is at most half the standard error of random rays, 5e-4 where half of the rays meet
  // the receiver. Aimed rays are as accurate with blockers.
  for (const Case& example : tableOfCases()) {
    const Measurement hemisphere = measured(example, &RayFormFactors::overHemisphere, {1 << 20});
    const Measurement aimed = measured(example, &RayFormFactors::aimed, {1 << 20});
    INFO(example.name << ": exact " << example.exact << ", hemisphere " << hemisphere.value << " +- "
                      << hemisphere.standardError << ", aimed " << aimed.value << " +- " << aimed.standardError);
    CHECK(std::abs(hemisphere.value - example.exact) < 2e-4);
    CHECK(std::abs(aimed.value - example.exact) < (example.isClose ? 1e-3 : 1e-4) * example.unhidden);
    CHECK(agrees(hemisphere, example.exact));
    CHECK(agrees(aimed, example.exact));
  }
}

TEST_CASE("RayFormFactors give the same bits for any number of threads", "[ray form factors]") {
  const auto rows = [](int threads) {
    const raster::ThreadLimit limit(threads);
    const DiscreteWorld world(tests::furnishedRoom(), 3);
    const Receivers receivers = everyElement(world.discretization);
    return std::pair{world.rays.overHemisphere(world.surface(1), receivers, {1 << 13}),
                     world.rays.aimed(world.surface(1), receivers, {1 << 9})};
  };
  const auto [hemisphere, aimed] = rows(1);
  for (const int threads : {2, 7}) {
    const auto [otherHemisphere, otherAimed] = rows(threads);
    CHECK(sameBits(otherHemisphere, hemisphere));
    CHECK(sameBits(otherAimed, aimed));
  }
}

TEST_CASE("RayFormFactors do not change for moved or scaled scenes, to the bit where coordinates are exact",
          "[ray form factors]") {
  const auto rows = [](double scale, double offset) {
    Scene scene = tests::furnishedRoom();
    scene.surfaces.pop_back();  // the sheet, whose corners are not binary fractions
    for (Surface& surface : scene.surfaces)
      for (Triangle& triangle : surface.triangles)
        for (glm::dvec3& corner : triangle.position) corner = scale * corner + offset;
    const DiscreteWorld world(tests::finish(std::move(scene)), 2);
    const Receivers receivers = everyElement(world.discretization);
    return std::pair{world.rays.overHemisphere(world.surface(1), receivers, {1 << 12}),
                     world.rays.aimed(world.surface(1), receivers, {1 << 9})};
  };
  const auto [hemisphere, aimed] = rows(1, 0);
  for (const auto& [scale, offset] : {std::pair{1.0, 1e6}, {0x1p-20, 0.0}, {0x1p20, 1e6}}) {
    const auto [otherHemisphere, otherAimed] = rows(scale, offset);
    INFO("scaled by " << scale << ", moved by " << offset);
    CHECK(sameBits(otherHemisphere, hemisphere));
    CHECK(sameBits(otherAimed, aimed));
  }
}

TEST_CASE("RayFormFactors in a closed room lose light only to backs", "[ray form factors]") {
  const DiscreteWorld world(tests::furnishedRoom(), 2);
  const Receivers receivers = everyElement(world.discretization);
  for (std::uint32_t surface = 0; surface < world.scene.surfaces.size(); ++surface) {
    const MeasuredRow row = world.rays.overHemisphere(world.surface(surface), receivers, {1 << 12});
    double sum = row.back.value;
    for (const Measurement& receiver : row.receivers) sum += receiver.value;
    INFO(world.scene.surfaces[surface].name);
    CHECK(row.background.value == 0);
    CHECK(sum == Approx(1).epsilon(1e-14));
    // Aimed rays compute the background as the difference from 1.
    const MeasuredRow aimed = world.rays.aimed(world.surface(surface), receivers, {1 << 11});
    CHECK(agrees(aimed.background, 0));
    CHECK(aimed.background.standardError < 0.02);
    CHECK(std::abs(aimed.back.value - row.back.value) <
          4 * std::hypot(aimed.back.standardError, row.back.standardError) + 1e-9);
  }
  // Without blockers that is the sum of the closed forms, exact at each point.
  const DiscreteWorld empty(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 3);
  const MeasuredRow row = empty.rays.aimed(empty.element(0), everyElement(empty.discretization), {1 << 9});
  CHECK(std::abs(row.background.value) < 1e-9);
  CHECK(row.background.standardError < 1e-9);
}

TEST_CASE("RayFormFactors satisfy reciprocity", "[ray form factors]") {
  // Reciprocity: area times form factor is the same in both directions.
  const DiscreteWorld world(tests::furnishedRoom());
  const Receivers receivers = everyElement(world.discretization);
  const std::size_t count = receivers.count;
  for (const Estimator estimator : bothEstimators) {
    std::vector<MeasuredRow> rows;
    for (std::uint32_t i = 0; i < count; ++i)
      rows.push_back((world.rays.*estimator)(world.surface(i), receivers, {1 << 11}));
    int beyond = 0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double areaI = world.discretization.elements[i].area, areaJ = world.discretization.elements[j].area;
        const Measurement &there = rows[i].receivers[j], &back = rows[j].receivers[i];
        beyond += std::abs(areaI * there.value - areaJ * back.value) >
                  4 * std::hypot(areaI * there.standardError, areaJ * back.standardError) + 1e-9;
      }
    CHECK(beyond == 0);
  }
}

TEST_CASE("RayFormFactors of a point are the closed forms of the visible elements", "[ray form factors]") {
  const DiscreteWorld world(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 3);
  const SurfacePoint place = elementCentre(world.scene, world.discretization, 2 * 9 + 1);
  const RaySource raySource = pointRaySource(world.scene, 2, place);
  const ShootingPoint point = shootingPoint(raySource, 0.5, 0.5);
  const Receivers receivers = everyElement(world.discretization);
  const MeasuredRow hemisphere = world.rays.overHemisphere(raySource, receivers, {1 << 14});
  const MeasuredRow aimed = world.rays.aimed(raySource, receivers, {64});
  for (std::uint32_t e = 0; e < receivers.count; ++e) {
    double exact = 0;
    for (const SurfacePiece& piece : world.rays.pieces().of(e))
      exact += pointToPolygon(point.position, point.normal, piece.corner);
    CHECK(agrees(hemisphere.receivers[e], exact));
    CHECK(aimed.receivers[e].value == Approx(exact).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("RayFormFactors of a patch are the area-weighted means of those of its elements", "[ray form factors]") {
  const DiscreteWorld world(tests::furnishedRoom(), 3, 2);
  const Patch& patch = world.discretization.patches.list[4];
  const std::vector<std::uint32_t>& elements = patch.elements;
  const Receivers receivers = everyElement(world.discretization);
  const MeasuredRow whole =
      world.rays.overHemisphere(areaRaySource(world.rays.pieces(), elements), receivers, {1 << 14});
  std::vector<double> mean(receivers.count), variance(receivers.count);
  double area = 0;
  for (const std::uint32_t e : elements) area += world.discretization.elements[e].area;
  for (const std::uint32_t e : elements) {
    const MeasuredRow part = world.rays.overHemisphere(world.element(e), receivers, {1 << 14, e});
    const double weight = world.discretization.elements[e].area / area;
    for (std::size_t r = 0; r < receivers.count; ++r) {
      mean[r] += weight * part.receivers[r].value;
      variance[r] += std::pow(weight * part.receivers[r].standardError, 2);
    }
  }
  int beyond = 0;
  for (std::size_t r = 0; r < receivers.count; ++r)
    beyond += std::abs(mean[r] - whole.receivers[r].value) >
              4 * std::sqrt(variance[r] + std::pow(whole.receivers[r].standardError, 2));
  CHECK(beyond == 0);
}

TEST_CASE("RayFormFactors to a group of elements are sums, and those to one element do not depend on the others",
          "[ray form factors]") {
  const DiscreteWorld world(tests::furnishedRoom(), 2);
  const Receivers every = everyElement(world.discretization);
  Receivers families{2, std::vector<std::uint32_t>(every.count, Receivers::none)};
  for (std::uint32_t e = 0; e < every.count; ++e) families.ofElement[e] = world.discretization.elements[e].surface < 6;
  for (const Estimator estimator : bothEstimators) {
    const auto row = [&](const Receivers& receivers) {
      return (world.rays.*estimator)(world.surface(1), receivers, {1 << 10});
    };
    const MeasuredRow all = row(every), grouped = row(families),
                      alone = row(tests::onlyElement(world.discretization, 5));
    double sums[2] = {0, 0};
    for (std::uint32_t e = 0; e < every.count; ++e) sums[families.ofElement[e]] += all.receivers[e].value;
    CHECK(grouped.receivers[0].value == Approx(sums[0]).epsilon(1e-12));
    CHECK(grouped.receivers[1].value == Approx(sums[1]).epsilon(1e-12));
    CHECK(alone.receivers[0].value == all.receivers[5].value);
    CHECK(alone.receivers[0].value + alone.back.value + alone.background.value == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("RayFormFactors in two-sided scenes reach both sides and meet no back", "[ray form factors]") {
  // A sheet halfway between two squares, with a twin: each square sees one side of it.
  Scene scene = tests::sceneOf({facingUp(unitSquare), facingDown(unitSquare, 1), facingDown(unitSquare, 0.5),
                                tests::parallelogram("twin", {0, 0, 0.5}, {1, 0, 0}, {0, 1, 0})});
  makeTwins(scene.surfaces, 2, 3);
  const DiscreteWorld world(scene);
  const Receivers receivers = everyElement(world.discretization);
  const double exact = parallelRectangles(unitSquare, unitSquare, 0.5);
  for (const Estimator estimator : bothEstimators)
    for (const auto& [from, to] : {std::pair<std::uint32_t, std::size_t>{0, 2}, {1, 3}}) {
      const MeasuredRow row = (world.rays.*estimator)(world.surface(from), receivers, {1 << 13});
      CHECK(agrees(row.receivers[to], exact));
      CHECK(row.receivers[5 - to].value == 0);
      CHECK(row.back.value == 0);
    }
}

TEST_CASE("RayFormFactors to a receiver that no ray met have an error of two rays", "[ray form factors]") {
  // A square of a thousandth of the side: 3e-7 of the light, which 1024 rays miss.
  const Interval side{0.5, 0.501};
  const double exact = parallelRectangles(unitSquare, {side, side}, 0.5);
  const Measurement estimate = measured(unblocked("tiny", facingUp(unitSquare), facingDown({side, side}, 0.5), exact),
                                        bothEstimators[0], {1 << 10});
  CHECK(estimate.value == 0);
  CHECK(estimate.standardError == 2.0 / 1024);
}

TEST_CASE("RayFormFactors lose no light in gaps of a millionth of the side", "[ray form factors]") {
  const double gap = 1e-6, exact = parallelRectangles(unitSquare, unitSquare, gap);
  const Case close = unblocked("close", facingUp(unitSquare), facingDown(unitSquare, gap), exact);
  CHECK(std::abs(measured(close, &RayFormFactors::overHemisphere, {1 << 14}).value - exact) < 1e-4);
  // Light leaves between the rims from a strip that contains few points or none.
  for (const double narrow : {1e-6, 1e-5, 1e-4}) {
    const double closed = parallelRectangles(unitSquare, unitSquare, narrow);
    const Measurement aimed =
        measured(unblocked("narrow", facingUp(unitSquare), facingDown(unitSquare, narrow), closed),
                 &RayFormFactors::aimed, {1 << 13});
    CHECK(std::abs(aimed.value - closed) <= 4 * aimed.standardError + (1 - closed));
  }
  const Case hidden = blocked("close, half hidden", gap, {{-1, 0.5}, {-1, 2}}, 0.5);
  CHECK(agrees(measured(hidden, &RayFormFactors::overHemisphere, {1 << 14}), hidden.exact));
}
