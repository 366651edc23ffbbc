#include "radiosity/spectra/spectrum.h"

#include <algorithm>
#include <array>
#include <string>

#include "radiosity/base/text_lines.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {

double valueAt(const Spectrum& spectrum, double wavelength) {
  const std::vector<double>& known = spectrum.wavelengths;
  const auto right = static_cast<std::size_t>(std::lower_bound(known.begin(), known.end(), wavelength) - known.begin());
  if (right == known.size()) return spectrum.values.back();
  if (right == 0 || known[right] == wavelength) return spectrum.values[right];
  const double share = (wavelength - known[right - 1]) / (known[right] - known[right - 1]);
  return spectrum.values[right - 1] + (spectrum.values[right] - spectrum.values[right - 1]) * share;
}

Spectrum parseSpectrum(std::string_view text, const std::filesystem::path& file) {
  Spectrum spectrum;
  LineReader lines(text, file);
  while (const std::optional<TextLine> line = lines.next()) {
    const Place place{file, line->number};
    std::array<double, 2> point{};
    if (readNumbers(line->text, point, place) != 2) fail(place, "a line has a wavelength in nm and a value");
    const auto [wavelength, value] = point;
    if (wavelength <= 0) fail(place, "the wavelength is not above 0", "give wavelengths in nm");
    if (!spectrum.wavelengths.empty() && wavelength <= spectrum.wavelengths.back())
      fail(place, "the wavelength is not above the one before", "sort the lines by wavelength");
    if (!(value >= 0 && value <= 1e30)) fail(place, "the value is not between 0 and 1e30");
    spectrum.wavelengths.push_back(wavelength);
    spectrum.values.push_back(value);
  }
  if (spectrum.wavelengths.empty()) throw raster::InputError(file.string(), 0, "holds no wavelength");
  return spectrum;
}

}  // namespace hemitex::radiosity
