// solve and refine in scenes with wavelengths: each band has the light that it has alone.
#include <algorithm>
#include <catch2/catch.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "radiosity/bands/spectral_scene.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/solver/dynamic_solution.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/spectra/colour.h"
#include "raster/base/parallel.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

const std::vector<double> wavelengths{400, 440, 480, 520, 560, 600, 640};
const Bands greys{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}, lights{7, 6, 5, 4, 3, 2, 1};

Scene furnace() {
  return inBands(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)),
                 {wavelengths, {{"grey", {{{wavelengths, greys}}, {{wavelengths, lights}}}}}}, 0.99);
}

/// A lamp in a box with spectra, at all wavelengths or only at some.
Scene litBox(std::vector<double> bands = wavelengths) {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  scene.materials.push_back(tests::material("lamp", glm::dvec3(0.1), glm::dvec3(1)));
  scene.surfaces.push_back(
      tests::quad("lamp", {{{0.3, 0.9, 0.3}, {0.6, 0.9, 0.3}, {0.6, 0.9, 0.7}, {0.3, 0.9, 0.7}}}, 1));
  SpectralBands spectra{std::move(bands), {}};
  spectra.materials["grey"].reflectance = {wavelengths, {0.3, 0.7, 0.5, 0.2, 0.8, 0.6, 0.4}};
  spectra.materials["lamp"].emission = {wavelengths, {1, 2, 3, 5, 8, 13, 21}};
  return inBands(tests::finish(std::move(scene)), spectra, 0.99);
}

struct Solved {
  Discretization discretization;
  Solution solution;
};

Solved solved(const Scene& scene, const DrawingSettings& drawing, const SolverSettings& settings = {},
              const Snapshot* snapshot = nullptr, const Progress& progress = {}) {
  Solved result{discretize(scene, {.texels = 6, .patch = 3}), {}};
  SceneFormFactors drawn(scene, result.discretization, layOut(result.discretization), drawing);
  result.solution = solve({.scene = scene,
                           .discretization = result.discretization,
                           .patches = result.discretization.patches,
                           .rowOf = drawn.rowOf(),
                           .split = drawn.splits(),
                           .settings = settings,
                           .outside = drawn.outsideFlux(),
                           .snapshot = snapshot},
                          progress);
  return result;
}

/// The largest relative difference of a band in two tables.
double difference(const BandTable& a, std::size_t bandOfA, const BandTable& b, std::size_t bandOfB) {
  double largest = 0;
  for (std::size_t e = 0; e < a.size(); ++e) largest = std::max(largest, std::abs(a[e][bandOfA] / b[e][bandOfB] - 1));
  return largest;
}

}  // namespace

TEST_CASE("solve gives a furnace a mean radiosity of E / (1 - r) in each of seven bands", "[bands]") {
  const Solved run = solved(furnace(), {.resolution = 64}, {.residual = 1e-8});
  for (std::size_t band = 0; band < 7; ++band) {
    double flux = 0, area = 0;
    for (std::size_t e = 0; e < run.discretization.elements.size(); ++e) {
      flux += run.discretization.elements[e].area * run.solution.radiosityInBands[e][6 - band];
      area += run.discretization.elements[e].area;
    }
    CHECK(flux / area == Approx(lights[band] / (1 - greys[band])).epsilon(1e-5));
  }
}

// The order of shots depends on all bands, and ends at a residual, which bounds the error.
TEST_CASE("solve gives each of seven bands what it has alone, and its account closes", "[bands]") {
  const SolverSettings settings{.residual = 1e-9};
  const DrawingSettings unsplit{.resolution = 32, .split = 1};
  Scene open = litBox();
  open.surfaces.erase(open.surfaces.begin());
  open.outside = {{1, 2, 3}, {{glm::normalize(glm::dvec3(-0.9, 0.1, 0.2)), {4, 5, 6}}}};
  const Scene closed = litBox();
  for (const Scene* scene : std::initializer_list<const Scene*>{&closed, &open}) {
    const Solved together = solved(*scene, unsplit, settings);
    const Energy& energy = together.solution.energy;
    for (std::size_t band = 0; band < 7; ++band) {
      Scene one = *scene;
      one.wavelengths = {scene->wavelengths[band]};
      const Solved alone = solved(one, unsplit, settings);
      CHECK(difference(together.solution.radiosityInBands, band, alone.solution.radiosityInBands, 0) < 1e-6);
      CHECK(energy.emitted[band] == Approx(alone.solution.energy.emitted[0]).epsilon(1e-12));
      CHECK(energy.absorbed[band] + energy.unshot[band] + energy.lost[band] ==
            Approx(energy.emitted[band]).epsilon(1e-12));
    }
  }
}

TEST_CASE("solve shows bands in the colours of their spectra", "[bands]") {
  const Solved run = solved(litBox(), {.resolution = 32});
  const Energy& energy = run.solution.energy;
  CHECK(energy.emitted.size() == 7);
  for (std::size_t e = 0; e < run.solution.radiosity.size(); ++e) {
    const auto bands = run.solution.radiosityInBands[e];
    const glm::dvec3 colour = linearSrgb({wavelengths, {bands.rbegin(), bands.rend()}});
    for (int channel = 0; channel < 3; ++channel)
      CHECK(run.solution.radiosity[e][channel] == Approx(colour[channel]).epsilon(1e-12).margin(1e-12));
  }
}

TEST_CASE("solve gives surfaces with maps the irradiance that their colours reflect as the radiosity", "[bands]") {
  Scene scene = litBox({450, 550, 650});
  scene.images.push_back({1, 1, {{0.5, 1, 0.25}}});
  scene.materials[0].reflectanceMap = 0;
  const Solved run = solved(scene, {.resolution = 32});
  for (std::uint32_t e = 0; e < run.solution.radiosity.size(); ++e) {
    const glm::dvec3 shown =
        emission(scene, run.discretization, e) + reflectance(scene, run.discretization, e) * run.solution.irradiance[e];
    for (int channel = 0; channel < 3; ++channel)
      CHECK(shown[channel] == Approx(run.solution.radiosity[e][channel]).epsilon(1e-12).margin(1e-12));
  }
  // The map scales each band by the channel that stands for it.
  Scene scaled = litBox({450, 550, 650});
  scaled.materials[0].reflectanceSpectrum = Spectrum{{450, 550, 650}, {0.25 * 0.65, 0.35, 0.5 * 0.375}};
  scene.materials[0].reflectanceSpectrum = Spectrum{{450, 550, 650}, {0.65, 0.35, 0.375}};
  const DrawingSettings drawing{.resolution = 32};
  const Solved mapped = solved(scene, drawing), plain = solved(scaled, drawing);
  for (std::size_t band = 0; band < 3; ++band)
    CHECK(difference(mapped.solution.radiosityInBands, band, plain.solution.radiosityInBands, band) < 1e-9);
}

TEST_CASE("solve has the same bits in bands for any number of threads, any row cache, and from a snapshot", "[bands]") {
  const Scene scene = litBox();
  const auto bitsOf = [&](const SolverSettings& settings) {
    return solved(scene, {.resolution = 32}, settings).solution.radiosityInBands;
  };
  const BandTable expected = bitsOf({});
  CHECK(bitsOf({.rowCacheBytes = 0}) == expected);
  std::string bytes;
  solved(scene, {.resolution = 32}, {}, nullptr, [&](const Step& step) {
    bytes = toBytes(step.snapshot());
    return step.shots < 20;
  });
  std::string_view rest = bytes;
  const Snapshot snapshot = takeSnapshot(rest);
  CHECK(solved(scene, {.resolution = 32}, {}, &snapshot).solution.radiosityInBands == expected);
  const raster::ThreadLimit one(1);
  CHECK(bitsOf({}) == expected);
}

// The absorbed flux of two solutions differs by at most the sum of their residuals, as shares of the emitted flux.
TEST_CASE("DynamicSolution updates bands after an edit as a new solution of the edited scene", "[bands]") {
  const SolverSettings settings{.residual = 1e-9};
  const DrawingSettings drawing{.resolution = 32, .split = 1};
  const Scene scene = litBox();
  const DiscretizationSettings elements{.texels = 6, .isUnburied = true, .patch = 3};
  const auto solutionOf = [&](const Scene& of, const Discretization& discretization) {
    SceneFormFactors drawn(of, discretization, layOut(discretization), drawing);
    return solve({.scene = of,
                  .discretization = discretization,
                  .patches = discretization.patches,
                  .rowOf = [&](const Patch& patch) { return drawn.uncorrected().ofPatch(patch); },
                  .settings = settings,
                  .isContinued = true});
  };
  const Discretization discretization = discretize(scene, elements);
  Solution first = solutionOf(scene, discretization);
  DynamicSolution dynamic(scene, discretization, std::move(first), {elements, drawing, settings},
                          [](const Discretization& of) { return layOut(of); });
  const std::vector<Edit> edits{Move{"lamp", {0.05, -0.1, 0}}, SetReflectance{"grey", {0.1, 0.2, 0.3}}};
  dynamic.update(edits);
  const Solution again = solutionOf(dynamic.scene(), dynamic.discretization());
  for (std::size_t band = 0; band < 7; ++band)
    CHECK(difference(dynamic.solution().radiosityInBands, band, again.radiosityInBands, band) < 1e-5);
}
