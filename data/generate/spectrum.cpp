#include "data/generate/spectrum.h"

#include <cassert>

namespace hemitex::data {
namespace {

struct Observer {
  int wavelength;  ///< nm
  double x, y, z;
};

/// Every fourth row of the 1 nm table of the CIE 1931 2-degree colour matching functions (ISO/CIE 11664-1; as published
/// by the Colour and Vision Research Laboratory, cvrl.org, file ciexyz31_1). Compared with all rows, the trapezoid rule
/// over these changes the band values of the Cornell box by less than 4e-4.
constexpr std::array<Observer, 76> observer{{
    {400, 0.01431, 0.000396, 0.06785001},
    {404, 0.02074801, 0.0005722187, 0.09854048},
    {408, 0.03388092, 0.00094116, 0.1613035},
    {412, 0.0550226, 0.001530752, 0.2626114},
    {416, 0.08695811, 0.0024548, 0.4162091},
    {420, 0.13438, 0.004, 0.6456},
    {424, 0.198611, 0.00654616, 0.959439},
    {428, 0.2587773, 0.00976768, 1.2581233},
    {432, 0.3048965, 0.01358272, 1.4948035},
    {436, 0.3343513, 0.01800736, 1.6564048},
    {440, 0.34828, 0.023, 1.74706},
    {444, 0.349287, 0.02835125, 1.7804334},
    {448, 0.3418088, 0.03452112, 1.7791982},
    {452, 0.3300411, 0.041768, 1.764039},
    {456, 0.3140251, 0.05024368, 1.7335595},
    {460, 0.2908, 0.06, 1.6692},
    {464, 0.2604227, 0.07091109, 1.564528},
    {468, 0.2184072, 0.0836668, 1.3898799},
    {472, 0.1733273, 0.09904584, 1.1878243},
    {476, 0.1321786, 0.117532, 0.9941976},
    {480, 0.09564, 0.13902, 0.8129501},
    {484, 0.06458099, 0.1627177, 0.6521049},
    {488, 0.04115088, 0.1912735, 0.5203376},
    {492, 0.0241444, 0.2267345, 0.4161836},
    {496, 0.01216179, 0.2701849, 0.3348578},
    {500, 0.0049, 0.323, 0.272},
    {504, 0.002236293, 0.3892875, 0.2234533},
    {508, 0.00517484, 0.4633944, 0.1792254},
    {512, 0.01553588, 0.544512, 0.1383758},
    {516, 0.03481485, 0.6293456, 0.1039048},
    {520, 0.06327, 0.71, 0.07824999},
    {524, 0.09945645, 0.7778368, 0.06078835},
    {528, 0.1423679, 0.8363068, 0.04775276},
    {532, 0.18914, 0.8849624, 0.03693564},
    {536, 0.2383209, 0.9237348, 0.02771181},
    {540, 0.2904, 0.954, 0.0203},
    {544, 0.3454828, 0.9760225, 0.01458461},
    {548, 0.4033784, 0.9903128, 0.01037792},
    {552, 0.464336, 0.9980983, 0.0073816},
    {556, 0.5282959, 0.9998567, 0.0053036},
    {560, 0.5945, 0.995, 0.0039},
    {564, 0.6615697, 0.9827241, 0.0029348},
    {568, 0.7288284, 0.9638568, 0.0023094},
    {572, 0.7948256, 0.9384992, 0.0019482},
    {576, 0.8579325, 0.9070064, 0.001766267},
    {580, 0.9163, 0.87, 0.001650001},
    {584, 0.9672179, 0.8275813, 0.001458533},
    {588, 1.0090892, 0.781192, 0.001205},
    {592, 1.040986, 0.7324224, 0.0010494},
    {596, 1.0597944, 0.6822192, 0.00096864},
    {600, 1.0622, 0.631, 0.0008},
    {604, 1.0509768, 0.5796379, 0.00064544},
    {608, 1.0226662, 0.5283528, 0.0004354},
    {612, 0.9793314, 0.4780304, 0.00028316},
    {616, 0.923194, 0.42908, 0.0002295467},
    {620, 0.8544499, 0.381, 0.00019},
    {624, 0.772954, 0.3328176, 0.0001168533},
    {628, 0.6856022, 0.2865936, 6.5e-05},
    {632, 0.6011138, 0.2448896, 3.948e-05},
    {636, 0.5225995, 0.2081616, 2.765333e-05},
    {640, 0.4479, 0.175, 2e-05},
    {644, 0.3775333, 0.1451259, 1.213333e-05},
    {648, 0.3130192, 0.1187792, 3.2e-06},
    {652, 0.2561184, 0.09618864, 0},
    {656, 0.2070971, 0.07712064, 0},
    {660, 0.1649, 0.061, 0},
    {664, 0.1291467, 0.04754965, 0},
    {668, 0.09969044, 0.03656384, 0},
    {672, 0.07680428, 0.02807664, 0},
    {676, 0.05980685, 0.02180077, 0},
    {680, 0.04677, 0.017, 0},
    {684, 0.03540461, 0.01283478, 0},
    {688, 0.02634484, 0.009533311, 0},
    {692, 0.01959988, 0.007085424, 0},
    {696, 0.01479064, 0.005343059, 0},
    {700, 0.01135916, 0.004102, 0},
}};

/// The integral from 400 to 700 nm in steps of 4 nm by the trapezoid rule: the end samples have half the weight.
glm::dvec3 integral(const Spectrum& spectrum) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const bool end = i == 0 || i + 1 == spectrum.size();
    sum += (end ? 0.5 : 1.0) * spectrum[i] * glm::dvec3{observer[i].x, observer[i].y, observer[i].z};
  }
  return sum;
}

/// The colour of chromaticity (x, y) with Y = 1.
glm::dvec3 xyzOfChromaticity(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

}  // namespace

int wavelength(std::size_t sample) { return observer[sample].wavelength; }

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

/// IEC 61966-2-1 gives the chromaticities of the primaries and of the white point, D65. The columns of the matrix from
/// RGB to XYZ are the primaries, scaled so that (1, 1, 1) is white with Y = 1. Let P be the matrix of the unscaled
/// primaries and W the white. Then the scales are s = P^-1 W, and XYZ = P diag(s) RGB.
glm::dmat3 linearSrgbFromXyz() {
  const glm::dmat3 primaries{xyzOfChromaticity(0.64, 0.33), xyzOfChromaticity(0.30, 0.60),
                             xyzOfChromaticity(0.15, 0.06)};
  const glm::dvec3 white = xyzOfChromaticity(0.3127, 0.3290);
  const glm::dvec3 scale = glm::inverse(primaries) * white;
  return glm::inverse(glm::dmat3{primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z});
}

glm::dvec3 linearSrgb(const Spectrum& spectrum) { return linearSrgbFromXyz() * tristimulus(spectrum); }

glm::dvec3 bandReflectance(const Spectrum& paint, const Spectrum& light) {
  return linearSrgb(product(paint, light)) / linearSrgb(light);
}

}  // namespace hemitex::data
