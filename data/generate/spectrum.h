/// From measured spectra to the three bands of a renderer.
///
/// All spectra here are sampled at 400, 404, ..., 700 nm, where the paints of the Cornell box were measured. Seen
/// through the colour matching functions of the CIE 1931 standard observer a spectrum S has the tristimulus values
///     X = k * integral S(l) x(l) dl,    Y = k * integral S(l) y(l) dl,    Z = k * integral S(l) z(l) dl,
/// with k such that S = 1 has Y = 1. A matrix takes them to linear sRGB, whose primaries are the bands of a scene.
///
/// An emitter has a band value: its linear sRGB. A paint has none of its own: what it does to a band depends on the
/// light that falls on it. Let L be the spectrum of a scene's light and r the paint's reflectance. What leaves the
/// paint has the spectrum r L, so the reflectance
///     r_c = RGB_c(r L) / RGB_c(L)
/// of band c is exact for all light that was reflected once. A grey paint keeps its reflectance, a perfect reflector
/// is (1, 1, 1). Further reflections are approximate, as they are for any three numbers. A colourful paint may leave
/// the triangle of the primaries, which shows as a negative r_c: nothing is clamped here.
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

/// Sample by sample.
Spectrum product(const Spectrum& a, const Spectrum& b);

/// Tristimulus values under the CIE 1931 2-degree observer; Spectrum 1 has Y = 1.
glm::dvec3 tristimulus(const Spectrum& spectrum);

/// The matrix from XYZ to linear sRGB, derived from the chromaticities of the primaries and the white point.
glm::dmat3 linearSrgbFromXyz();

/// Linear sRGB; a channel is negative where the colour lies outside the triangle of the primaries.
glm::dvec3 linearSrgb(const Spectrum& spectrum);

/// The reflectance of each band under a light, not clamped.
glm::dvec3 bandReflectance(const Spectrum& paint, const Spectrum& light);

}  // namespace hemitex::data
