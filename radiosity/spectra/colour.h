/// Colours of spectra. A spectrum S has the tristimulus values
///
///     X = k sum S(l) x(l),    Y = k sum S(l) y(l),    Z = k sum S(l) z(l)
///
/// over 360, 361, ..., 830 nm, with the functions of the CIE 1931 2-degree observer and k such that S = 1 has Y = 1. A
/// matrix converts them to linear sRGB (IEC 61966-2-1). A channel of a colour outside the triangle of the sRGB
/// primaries is negative; nothing is clamped here.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/base/bands.h"
#include "radiosity/spectra/spectrum.h"

namespace hemitex::radiosity {

/// The tristimulus values of a spectrum that is 1 at one wavelength of a list and 0 at the others, for each one. By
/// them, spectra with these wavelengths have their values as a sum. The wavelengths ascend, in nm; at least one.
std::vector<glm::dvec3> tristimulusOfBands(std::span<const double> wavelengths);

/// The matrix from XYZ to linear sRGB, from the chromaticities of the primaries and of the white point, D65.
glm::dmat3 linearSrgbFromXyz();

/// As tristimulusOfBands, in linear sRGB.
std::vector<glm::dvec3> linearSrgbOfBands(std::span<const double> wavelengths);

/// The linear sRGB of a spectrum of light.
glm::dvec3 linearSrgb(const Spectrum& spectrum);

/// The reflectance per RGB band of a surface with this reflectance: under light of equal energy, the linear sRGB of the
/// reflected light over that of the light. A grey keeps its value.
glm::dvec3 reflectanceColour(const Spectrum& spectrum);

/// Converts values in bands to colours. Without wavelengths the bands are R, G and B.
class BandColours {
 public:
  /// The wavelengths descend, in nm.
  explicit BandColours(const std::vector<double>& wavelengths);

  glm::dvec3 of(std::span<const double> values) const;
  std::vector<glm::dvec3> of(const BandTable& table) const;

 private:
  std::vector<glm::dvec3> ofBands_;
};

/// The irradiance whose reflection, with the emission, is this radiosity; 0 where nothing is reflected.
glm::dvec3 irradianceFor(const glm::dvec3& radiosity, const glm::dvec3& emission, const glm::dvec3& reflectance);

}  // namespace hemitex::radiosity
