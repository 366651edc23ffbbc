/// Conversion of spectra to bands, compared with the standard observer.
#include <catch2/catch.hpp>

#include "data/generate/spectrum.h"

using namespace hemitex::data;

namespace {

Spectrum constant(double value) { return piecewiseLinear({{400, value}, {700, value}}); }

/// A warm light, like a bulb: twice as strong at 700 nm as in the middle, dark at 400 nm.
Spectrum warmLight() { return piecewiseLinear({{400, 0}, {700, 1}}); }

/// A paint that reflects only wavelengths above 600 nm.
Spectrum redPaint() { return piecewiseLinear({{400, 0}, {600, 0}, {604, 0.6}, {700, 0.6}}); }

}  // namespace

TEST_CASE("wavelength of the samples of a spectrum is 400, 404, ..., 700 nm", "[data]") {
  for (std::size_t i = 0; i < Spectrum{}.size(); ++i) CHECK(wavelength(i) == 400 + 4 * static_cast<int>(i));
  CHECK(wavelength(Spectrum{}.size() - 1) == 700);
}

TEST_CASE("piecewiseLinear passes through its corners and is straight between them", "[data]") {
  const Spectrum spectrum = piecewiseLinear({{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}});
  CHECK(spectrum[0] == 0);
  CHECK(spectrum[25] == 8);
  CHECK(spectrum[50] == 15.6);
  CHECK(spectrum[75] == 18.4);
  CHECK(spectrum[24] == Approx(8 * 96 / 100.0).epsilon(1e-15));
  CHECK(spectrum[51] == Approx(15.6 + 2.8 * 4 / 100.0).epsilon(1e-15));
}

// The CIE scaled its functions so that an equal-energy spectrum has X = Y = Z: summed over 360 to 830 nm in steps of 1
// nm they are 106.8655, 106.8569 and 106.8923. The parts of these sums between 400 and 700 nm are 106.5823, 106.7939
// and 106.3353, which gives X / Y = 0.99802 and Z / Y = 0.99571. Steps of 4 nm change that by less than 1e-4.
TEST_CASE("tristimulus of an equal-energy spectrum is a white of luminance 1", "[data]") {
  const glm::dvec3 white = tristimulus(constant(1));
  CHECK(white.y == 1);
  CHECK(white.x == Approx(106.5823 / 106.7939).margin(1e-4));
  CHECK(white.z == Approx(106.3353 / 106.7939).margin(1e-4));
}

TEST_CASE("tristimulus is linear in the spectrum", "[data]") {
  const glm::dvec3 once = tristimulus(redPaint());
  const glm::dvec3 thrice = tristimulus(product(constant(3), redPaint()));
  for (int c = 0; c < 3; ++c) CHECK(thrice[c] == Approx(3 * once[c]).epsilon(1e-14));
}

TEST_CASE("bandReflectance of grey paint is its reflectance in each band, for any light", "[data]") {
  for (const double grey : {0.0, 0.18, 0.78, 1.0}) {
    const glm::dvec3 bands = bandReflectance(constant(grey), warmLight());
    for (int c = 0; c < 3; ++c) CHECK(bands[c] == Approx(grey).margin(1e-14));
  }
}

TEST_CASE("bandReflectance times light is the colour of the reflected spectrum", "[data]") {
  const glm::dvec3 spectral = linearSrgb(product(redPaint(), warmLight()));
  const glm::dvec3 banded = bandReflectance(redPaint(), warmLight()) * linearSrgb(warmLight());
  for (int c = 0; c < 3; ++c) CHECK(banded[c] == Approx(spectral[c]).margin(1e-14));
}

TEST_CASE("bandReflectance of deep red paint lies outside the primaries, and is not clamped", "[data]") {
  const glm::dvec3 bands = bandReflectance(redPaint(), warmLight());
  CHECK(bands.r > 0.3);
  CHECK(bands.b < 0);
}
