// Spectra (.rfl) and their colours: a spectrum has its values at its points.
#include <stdexcept>

#include "radiosity/spectra/colour.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::ignoringInputErrors([&] {
    const radiosity::Spectrum spectrum = radiosity::parseSpectrum(fuzz::textOf(data, size), "a.rfl");
    for (std::size_t p = 0; p < spectrum.wavelengths.size(); ++p)
      if (radiosity::valueAt(spectrum, spectrum.wavelengths[p]) != spectrum.values[p])
        throw std::logic_error("has another value at a point");
    radiosity::linearSrgb(spectrum);
    radiosity::reflectanceColour(spectrum);
  });
}
