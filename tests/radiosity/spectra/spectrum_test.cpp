#include "radiosity/spectra/spectrum.h"

#include <catch2/catch.hpp>
#include <string>

#include "raster/base/input_error.h"

using namespace hemitex::radiosity;
using hemitex::raster::InputError;

TEST_CASE("valueAt has the bits of each point, straight lines between them, and the ends outside", "[spectra]") {
  const Spectrum spectrum{{400, 500, 700}, {0.1, 0.3, 0.7}};
  for (std::size_t i = 0; i < 3; ++i) CHECK(valueAt(spectrum, spectrum.wavelengths[i]) == spectrum.values[i]);
  CHECK(valueAt(spectrum, 450) == Approx(0.2).epsilon(1e-15));
  CHECK(valueAt(spectrum, 650) == Approx(0.6).epsilon(1e-15));
  CHECK(valueAt(spectrum, 1) == 0.1);
  CHECK(valueAt(spectrum, 1e9) == 0.7);
  CHECK(valueAt({{550}, {2}}, 300) == 2);
}

TEST_CASE("parseSpectrum reads lines of a wavelength and a value, with comments and any line ends", "[spectra]") {
  const Spectrum expected{{400, 500.5}, {0.25, 1}};
  CHECK(parseSpectrum("400 0.25\n500.5 1\n", "a.rfl") == expected);
  CHECK(parseSpectrum("# measured\r\n  400\t0.25 # at night\r\n\r\n500.5 1e0", "a.rfl") == expected);
}

TEST_CASE("parseSpectrum refuses what is no spectrum, with the file and the line", "[spectra]") {
  struct Bad {
    std::string text;
    int line;
    std::string what;
  };
  for (const Bad& bad :
       {Bad{"400 0.2\n400 0.3\n", 2, "not above the one before"},
        Bad{"500 0.2\n\n400 0.3\n", 3, "not above the one before"}, Bad{"400\n", 1, "a wavelength in nm"},
        Bad{"400 0.2 0.3\n", 1, "too many"}, Bad{"400 -0.2\n", 1, "between 0 and 1e30"},
        Bad{"400 1e31\n", 1, "between 0 and 1e30"}, Bad{"0 0.2\n", 1, "not above 0"}, Bad{"400 nan\n", 1, "finite"},
        Bad{"400,0.2\n", 1, "not a number"}, Bad{"# none\n", 0, "no wave"}}) {
    INFO(bad.text);
    try {
      parseSpectrum(bad.text, "paint.rfl");
      FAIL("it was read");
    } catch (const InputError& error) {
      CHECK(error.file() == "paint.rfl");
      CHECK(error.line() == bad.line);
      CHECK_THAT(error.what(), Catch::Contains(bad.what));
    }
  }
}
