#include "data/generate/spectrum.h"

#include <cassert>

#include "radiosity/spectra/colour.h"
#include "radiosity/spectra/observer.h"

namespace hemitex::data {
namespace {

/// The integral from 400 to 700 nm in steps of 4 nm by the trapezoid rule: the end samples have half the weight.
/// Compared with steps of 1 nm this changes the band values of the Cornell box by less than 4e-4.
glm::dvec3 integral(const Spectrum& spectrum) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const bool end = i == 0 || i + 1 == spectrum.size();
    sum += (end ? 0.5 : 1.0) * spectrum[i] * radiosity::observerAt(wavelength(i));
  }
  return sum;
}

}  // namespace

int wavelength(std::size_t sample) { return 400 + 4 * static_cast<int>(sample); }

Spectrum piecewiseLinear(const std::vector<SpectrumPoint>& points) {
  assert(points.size() >= 2 && points.front().wavelength <= 400 && points.back().wavelength >= 700);
  Spectrum spectrum;
  std::size_t right = 1;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    while (points[right].wavelength < wavelength(i)) ++right;
    const SpectrumPoint& a = points[right - 1];
    const SpectrumPoint& b = points[right];
    spectrum[i] = a.value + (b.value - a.value) * (wavelength(i) - a.wavelength) / (b.wavelength - a.wavelength);
  }
  return spectrum;
}

Spectrum product(const Spectrum& a, const Spectrum& b) {
  Spectrum spectrum;
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] = a[i] * b[i];
  return spectrum;
}

glm::dvec3 tristimulus(const Spectrum& spectrum) {
  Spectrum flat;
  flat.fill(1.0);
  return integral(spectrum) / integral(flat).y;
}

glm::dvec3 linearSrgb(const Spectrum& spectrum) { return radiosity::linearSrgbFromXyz() * tristimulus(spectrum); }

glm::dvec3 bandReflectance(const Spectrum& paint, const Spectrum& light) {
  return linearSrgb(product(paint, light)) / linearSrgb(light);
}

}  // namespace hemitex::data
