#include "radiosity/spectra/colour.h"

#include <algorithm>
#include <cassert>

#include "radiosity/spectra/observer.h"

namespace hemitex::radiosity {
namespace {

/// The colour of chromaticity (x, y) with Y = 1.
glm::dvec3 xyzOfChromaticity(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

}  // namespace

std::vector<glm::dvec3> tristimulusOfBands(std::span<const double> wavelengths) {
  assert(!wavelengths.empty());
  std::vector<glm::dvec3> sums(wavelengths.size(), glm::dvec3(0));
  double whole = 0;  // Y of equal energy
  std::size_t right = 0;
  for (int at = firstWavelength; at <= lastWavelength; ++at) {
    const glm::dvec3 matching = observerAt(at);
    whole += matching.y;
    while (right < wavelengths.size() && wavelengths[right] < at) ++right;
    if (right == 0 || right == wavelengths.size()) {
      sums[right == 0 ? 0 : right - 1] += matching;
      continue;
    }
    const double share = (at - wavelengths[right - 1]) / (wavelengths[right] - wavelengths[right - 1]);
    sums[right - 1] += (1 - share) * matching;
    sums[right] += share * matching;
  }
  for (glm::dvec3& sum : sums) sum /= whole;
  return sums;
}

/// The columns of the matrix from RGB to XYZ are the primaries, scaled so that (1, 1, 1) is white with Y = 1. Let P be
/// the matrix of the unscaled primaries and W the white. Then the scales are s = P^-1 W, and XYZ = P diag(s) RGB.
glm::dmat3 linearSrgbFromXyz() {
  const glm::dmat3 primaries{xyzOfChromaticity(0.64, 0.33), xyzOfChromaticity(0.30, 0.60),
                             xyzOfChromaticity(0.15, 0.06)};
  const glm::dvec3 white = xyzOfChromaticity(0.3127, 0.3290);
  const glm::dvec3 scale = glm::inverse(primaries) * white;
  return glm::inverse(glm::dmat3{primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z});
}

std::vector<glm::dvec3> linearSrgbOfBands(std::span<const double> wavelengths) {
  const glm::dmat3 matrix = linearSrgbFromXyz();
  std::vector<glm::dvec3> colours = tristimulusOfBands(wavelengths);
  for (glm::dvec3& colour : colours) colour = matrix * colour;
  return colours;
}

glm::dvec3 linearSrgb(const Spectrum& spectrum) {
  const std::vector<glm::dvec3> ofBands = linearSrgbOfBands(spectrum.wavelengths);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < ofBands.size(); ++i) sum += spectrum.values[i] * ofBands[i];
  return sum;
}

glm::dvec3 reflectanceColour(const Spectrum& spectrum) {
  return linearSrgb(spectrum) / linearSrgb({spectrum.wavelengths, std::vector<double>(spectrum.values.size(), 1.0)});
}

BandColours::BandColours(const std::vector<double>& wavelengths)
    : ofBands_(wavelengths.empty() ? std::vector<glm::dvec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}
                                   : linearSrgbOfBands(std::vector(wavelengths.rbegin(), wavelengths.rend()))) {
  if (!wavelengths.empty()) std::reverse(ofBands_.begin(), ofBands_.end());
}

glm::dvec3 BandColours::of(std::span<const double> values) const {
  glm::dvec3 colour(0);
  for (std::size_t band = 0; band < values.size(); ++band) colour += ofBands_[band] * values[band];
  return colour;
}

std::vector<glm::dvec3> BandColours::of(const BandTable& table) const {
  std::vector<glm::dvec3> colours(table.size());
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = of(table[i]);
  return colours;
}

glm::dvec3 irradianceFor(const glm::dvec3& radiosity, const glm::dvec3& emission, const glm::dvec3& reflectance) {
  glm::dvec3 irradiance(0);
  for (int channel = 0; channel < 3; ++channel)
    if (reflectance[channel] > 0) irradiance[channel] = (radiosity[channel] - emission[channel]) / reflectance[channel];
  return irradiance;
}

}  // namespace hemitex::radiosity
