/// A spectrum, such as a reflectance by wavelength, and its files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace hemitex::radiosity {

/// Straight lines between its points. Outside of them it has the value of the nearest point, as CIE 15:2004 advises for
/// values that were not measured.
struct Spectrum {
  std::vector<double> wavelengths;  ///< nm, ascending; at least one
  std::vector<double> values;       ///< one per wavelength

  bool operator==(const Spectrum&) const = default;
};

/// The value at a wavelength in nm; at that of a point, the bits of the point.
double valueAt(const Spectrum& spectrum, double wavelength);

/// The spectrum of a `.rfl` file: one line per point, with the wavelength in nm and the value, from 0 to 1e30.
/// Comments begin with `#`. Throws InputError with the line.
Spectrum parseSpectrum(std::string_view text, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
