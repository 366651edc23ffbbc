#include "radiosity/bands/colour_solution.h"

#include <catch2/catch.hpp>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/spectra/colour.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Groups with given radiosities: `of` returns that of an element in a band.
template <typename Of>
BandSolution solutionOf(const std::vector<double>& wavelengths, std::size_t elements, const Of& of) {
  BandSolution solution{wavelengths, std::vector<Solution>(groupsOfBands(wavelengths.size()).size())};
  for (Solution& group : solution.groups) group.radiosity.resize(elements);
  for (std::size_t band = 0; band < wavelengths.size(); ++band) {
    const BandPlace at = placeOf(band, wavelengths.size());
    for (std::size_t e = 0; e < elements; ++e) solution.groups[at.group].radiosity[e][at.place] = of(band, e);
    solution.groups[at.group].energy.emitted[at.place] = of(band, 0);
    solution.groups[at.group].ambient[at.place] = of(band, 1);
  }
  return solution;
}

}  // namespace

TEST_CASE("inColour gives each element the colour of its spectrum", "[bands]") {
  const Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  const Discretization discretization = discretize(scene, {.texels = 2});
  const std::vector<double> wavelengths{420, 470, 520, 570, 620};
  const auto valueOf = [](std::size_t band, std::size_t element) {
    return static_cast<double>((band * 7 + element * 3) % 11);
  };
  const BandSolution bands = solutionOf(wavelengths, discretization.elements.size(), valueOf);
  const Solution colours = inColour(scene, discretization, bands);
  for (std::size_t e = 0; e < discretization.elements.size(); ++e) {
    Spectrum spectrum{wavelengths, {}};
    for (std::size_t band = 0; band < 5; ++band) {
      spectrum.values.push_back(valueOf(band, e));
      CHECK(radiosityIn(bands, band, e) == valueOf(band, e));
    }
    const glm::dvec3 expected = linearSrgb(spectrum);
    for (int c = 0; c < 3; ++c) CHECK(colours.radiosity[e][c] == Approx(expected[c]).epsilon(1e-12).margin(1e-12));
    if (e == 0) CHECK(colours.energy.emitted == colours.radiosity[e]);
    if (e == 1) CHECK(colours.ambient == colours.radiosity[e]);
  }
  for (std::size_t band = 0; band < 5; ++band) CHECK(fluxIn(bands, band, &Energy::emitted) == valueOf(band, 0));
  CHECK(colours.irradiance.empty());
}

TEST_CASE("inColour gives surfaces with maps the irradiance that their colours reflect as the radiosity", "[bands]") {
  Scene scene = tests::closedCube({0.5, 0.25, 0}, {0.1, 0.2, 0.3});
  scene.images.push_back({1, 1, {{0.5, 1, 1}}});
  scene.materials[0].reflectanceMap = 0;
  const Discretization discretization = discretize(scene, {.texels = 2});
  const BandSolution bands = solutionOf({450, 550, 650}, discretization.elements.size(),
                                        [](std::size_t band, std::size_t) { return 1.0 + static_cast<double>(band); });
  const Solution colours = inColour(scene, discretization, bands);
  for (std::size_t e = 0; e < discretization.elements.size(); ++e)
    for (int c = 0; c < 2; ++c)
      CHECK(scene.materials[0].emission[c] + discretization.mappedReflectance[e][c] * colours.irradiance[e][c] ==
            Approx(colours.radiosity[e][c]).epsilon(1e-14));
  CHECK(colours.irradiance[0].b == 0);  // nothing is reflected
}

TEST_CASE("inColour sums shots, and has the largest residual and the warnings of the group that emits most",
          "[bands]") {
  const Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  const Discretization discretization = discretize(scene, {.texels = 1});
  BandSolution bands =
      solutionOf({400, 450, 550, 650}, discretization.elements.size(), [](std::size_t, std::size_t) { return 1.0; });
  bands.groups[0].shots = 3;
  bands.groups[1].shots = 4;
  bands.groups[0].residual = 0.5;
  bands.groups[0].warnings = {{"a"}};
  bands.groups[1].warnings = {{"b"}};
  bands.groups[1].isInterrupted = true;
  const Solution colours = inColour(scene, discretization, bands);
  CHECK(colours.shots == 7);
  CHECK(colours.residual == 0.5);
  REQUIRE(colours.warnings.size() == 1);
  CHECK(colours.warnings[0].text == "a");
  CHECK(colours.isInterrupted);
}
