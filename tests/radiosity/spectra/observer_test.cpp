#include "radiosity/spectra/observer.h"

#include <catch2/catch.hpp>

using namespace hemitex::radiosity;

// The CIE scaled its functions so that the spectrum of equal energy has X = Y = Z. The published sums over the table of
// 1 nm are 106.8655, 106.8569 and 106.8923 (Wyszecki and Stiles, Color Science, table I(3.3.1)).
TEST_CASE("observerAt sums to the published sums over 360 to 830 nm", "[spectra]") {
  glm::dvec3 sum(0);
  for (int wavelength = firstWavelength; wavelength <= lastWavelength; ++wavelength) sum += observerAt(wavelength);
  CHECK(sum.x == Approx(106.8655).margin(1e-4));
  CHECK(sum.y == Approx(106.8569).margin(1e-4));
  CHECK(sum.z == Approx(106.8923).margin(1e-4));
}

// y is the luminous efficiency V of 1924, which is 1 at 555 nm.
TEST_CASE("observerAt has the luminous efficiency as y: at most 1, at 555 nm", "[spectra]") {
  for (int wavelength = firstWavelength; wavelength <= lastWavelength; ++wavelength) {
    CHECK(observerAt(wavelength).y <= 1.0000001);
    if (wavelength < 555) CHECK(observerAt(wavelength).y < observerAt(wavelength + 1).y);
    if (wavelength > 556) CHECK(observerAt(wavelength).y <= observerAt(wavelength - 1).y);
  }
  CHECK(observerAt(555).y == Approx(1).margin(1e-9));
}

TEST_CASE("observerAt has the published chromaticities of monochromatic light", "[spectra]") {
  struct Known {
    int wavelength;
    double x, y;
  };
  // Wyszecki and Stiles, table I(3.3.1).
  for (const Known& known :
       {Known{400, 0.1733, 0.0048}, Known{450, 0.1566, 0.0177}, Known{480, 0.0913, 0.1327}, Known{500, 0.0082, 0.5384},
        Known{520, 0.0743, 0.8338}, Known{550, 0.3016, 0.6923}, Known{580, 0.5125, 0.4866}, Known{600, 0.6270, 0.3725},
        Known{650, 0.7260, 0.2740}, Known{700, 0.7347, 0.2653}}) {
    const glm::dvec3 xyz = observerAt(known.wavelength);
    const double sum = xyz.x + xyz.y + xyz.z;
    CHECK(xyz.x / sum == Approx(known.x).margin(6e-5));
    CHECK(xyz.y / sum == Approx(known.y).margin(6e-5));
  }
}
