/// Converts measured spectra to the three bands of a renderer.
///
/// All spectra are sampled at 400, 404, ..., 700 nm, where the paints of the Cornell box were measured. With the colour
/// matching functions of the CIE 1931 standard observer, a spectrum S has the tristimulus values
///
///     X = k * integral S(l) x(l) dl,    Y = k * integral S(l) y(l) dl,    Z = k * integral S(l) z(l) dl,
///
/// with k such that S = 1 has Y = 1. A matrix converts them to linear sRGB, whose primaries are the bands of a scene.
///
/// The band values of an emitter are its linear sRGB. Those of a paint depend on the light on it. Let L be the spectrum
/// of a scene's light and r the paint's reflectance. The reflected light has the spectrum r L, so the reflectance
///
///     r_c = RGB_c(r L) / RGB_c(L)
///
/// of band c is exact for all light after one reflection. A grey paint keeps its reflectance; a perfect reflector is
/// (1, 1, 1). Further reflections are approximate, as with any three numbers. The colour of a saturated paint may lie
/// outside the triangle of the primaries, which gives a negative r_c: values are not clamped.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace hemitex::data {

/// One value at each of 400, 404, ..., 700 nm.
using Spectrum = std::array<double, 76>;

/// The wavelength of a sample, in nm.
int wavelength(std::size_t sample);

/// The corner of a polyline: a value at a wavelength in nm.
struct SpectrumPoint {
  double wavelength = 0;
  double value = 0;
};

/// The polyline through the points, which ascend in wavelength and span 400 to 700 nm.
Spectrum piecewiseLinear(const std::vector<SpectrumPoint>& points);

/// The product per sample.
Spectrum product(const Spectrum& a, const Spectrum& b);

/// Tristimulus values under the CIE 1931 2-degree observer; Spectrum 1 has Y = 1.
glm::dvec3 tristimulus(const Spectrum& spectrum);

/// Linear sRGB; a channel is negative if the colour lies outside the triangle of the primaries.
glm::dvec3 linearSrgb(const Spectrum& spectrum);

/// The reflectance of each band under a light, not clamped.
glm::dvec3 bandReflectance(const Spectrum& paint, const Spectrum& light);

}  // namespace hemitex::data
