#include "radiosity/spectra/colour.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "radiosity/spectra/observer.h"

using namespace hemitex::radiosity;

namespace {

std::vector<double> evenly(double first, double last, double step) {
  std::vector<double> wavelengths;
  for (double at = first; at <= last; at += step) wavelengths.push_back(at);
  return wavelengths;
}

/// The chromaticity (x, y) of a spectrum.
glm::dvec2 chromaticity(const Spectrum& spectrum) {
  const std::vector<glm::dvec3> ofBands = tristimulusOfBands(spectrum.wavelengths);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < ofBands.size(); ++i) sum += spectrum.values[i] * ofBands[i];
  return glm::dvec2(sum) / (sum.x + sum.y + sum.z);
}

/// A black body of a temperature in K, relative (Planck 1900), with the second radiation constant in nm K.
Spectrum blackBody(double temperature, double second, const std::vector<double>& wavelengths) {
  Spectrum spectrum{wavelengths, {}};
  for (const double l : wavelengths)
    spectrum.values.push_back(std::pow(l / 560, -5) / (std::exp(second / (l * temperature)) - 1));
  return spectrum;
}

Spectrum constant(double value, const std::vector<double>& wavelengths) {
  return {wavelengths, std::vector<double>(wavelengths.size(), value)};
}

}  // namespace

TEST_CASE("tristimulusOfBands gives equal energy x = y = 1/3 and Y = 1, whatever the bands", "[spectra]") {
  for (const auto& wavelengths : {evenly(360, 830, 1), evenly(400, 700, 10), evenly(450, 650, 100), evenly(550, 550, 1),
                                  evenly(100, 3000, 7.3)}) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& band : tristimulusOfBands(wavelengths)) sum += band;
    CHECK(sum.y == Approx(1).epsilon(1e-14));
    const glm::dvec2 xy = chromaticity(constant(1, wavelengths));
    CHECK(xy.x == Approx(1 / 3.0).margin(5e-5));  // the sums of the table are equal to this accuracy
    CHECK(xy.y == Approx(1 / 3.0).margin(5e-5));
  }
}

TEST_CASE("tristimulusOfBands with bands of 1 nm is the table of the observer", "[spectra]") {
  const std::vector<glm::dvec3> bands = tristimulusOfBands(evenly(360, 830, 1));
  const double scale = observerAt(555).y / bands[195].y;
  for (std::size_t i = 0; i < bands.size(); ++i)
    for (int c = 0; c < 3; ++c)
      CHECK(bands[i][c] * scale == Approx(observerAt(360 + static_cast<int>(i))[c]).epsilon(1e-12).margin(1e-15));
}

TEST_CASE("tristimulusOfBands divides each table row between its two bands in proportion to distance", "[spectra]") {
  // A spectrum that is linear in wavelength is met exactly by any bands that span the table.
  Spectrum fine{evenly(360, 830, 1), {}}, coarse{evenly(350, 850, 50), {}};
  for (Spectrum* spectrum : {&fine, &coarse})
    for (const double l : spectrum->wavelengths) spectrum->values.push_back(l / 1000);
  const glm::dvec3 a = linearSrgb(fine), b = linearSrgb(coarse);
  for (int c = 0; c < 3; ++c) CHECK(a[c] == Approx(b[c]).epsilon(1e-12));
}

// CIE standard illuminant A is a black body of 2848 K with the second radiation constant of 1931, 1.4350e7 nm K. Its
// chromaticity is (0.44757, 0.40745) by the definition of ISO 11664-2.
TEST_CASE("linearSrgb sees illuminant A at its chromaticity", "[spectra]") {
  const glm::dvec2 fine = chromaticity(blackBody(2848, 1.4350e7, evenly(360, 830, 1)));
  CHECK(fine.x == Approx(0.44757).margin(2e-5));
  CHECK(fine.y == Approx(0.40745).margin(2e-5));
  const glm::dvec2 coarse = chromaticity(blackBody(2848, 1.4350e7, evenly(380, 780, 10)));
  CHECK(coarse.x == Approx(0.44757).margin(3e-4));
  CHECK(coarse.y == Approx(0.40745).margin(3e-4));
}

// The relative power of CIE standard illuminant D65 (ISO 11664-2) from 380 to 780 nm in steps of 10 nm. Its
// chromaticity is that of the white of sRGB, (0.3127, 0.3290).
TEST_CASE("linearSrgb of D65 is grey", "[spectra]") {
  const Spectrum d65{evenly(380, 780, 10),
                     {49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
                      108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880, 88.6856,
                      90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091,
                      74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828}};
  const glm::dvec3 colour = linearSrgb(d65);
  CHECK(colour.r / colour.g == Approx(1).margin(0.001));
  CHECK(colour.b / colour.g == Approx(1).margin(0.001));
  CHECK(chromaticity(d65).x == Approx(0.3127).margin(1e-4));
  CHECK(chromaticity(d65).y == Approx(0.3290).margin(1e-4));
}

TEST_CASE("linearSrgbFromXyz maps D65 to white with all channels 1", "[spectra]") {
  const glm::dvec3 d65{0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
  const glm::dvec3 rgb = linearSrgbFromXyz() * d65;
  for (int c = 0; c < 3; ++c) CHECK(rgb[c] == Approx(1).epsilon(1e-14));
}

// IEC 61966-2-1 prints this matrix. It is the inverse of a matrix rounded to four digits. An inverse with entries up to
// 3.2 magnifies the rounding error of 5e-5 to a few 1e-4.
TEST_CASE("linearSrgbFromXyz is the matrix that the standard prints", "[spectra]") {
  const double printed[3][3] = {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
  const glm::dmat3 matrix = linearSrgbFromXyz();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) CHECK(matrix[column][row] == Approx(printed[row][column]).margin(5e-4));
}

TEST_CASE("linearSrgb of a deep red lies outside sRGB and is not clamped", "[spectra]") {
  const glm::dvec3 red = linearSrgb({{640, 650, 660}, {0, 0, 1}});
  CHECK(red.r > 0);
  CHECK(red.g < 0);
}

TEST_CASE("reflectanceColour of a grey is the grey in each channel", "[spectra]") {
  for (const double grey : {0.0, 0.18, 0.999})
    for (const auto& wavelengths : {evenly(400, 700, 10), evenly(450, 650, 100)})
      for (int c = 0; c < 3; ++c)
        CHECK(reflectanceColour(constant(grey, wavelengths))[c] == Approx(grey).margin(1e-13));
}

// Metamers: two reflectances that differ by a spectrum of colour 0. Under equal energy they look alike, under a bulb
// they do not.
TEST_CASE("reflectanceColour is equal for metamers, whose colours under a bulb differ", "[spectra]") {
  const std::vector<double> wavelengths = evenly(400, 700, 100);
  const std::vector<glm::dvec3> c = tristimulusOfBands(wavelengths);
  // The first three weights of a spectrum with colour 0 and the value 1 in the last band.
  const glm::dvec3 black = glm::inverse(glm::dmat3(c[0], c[1], c[2])) * -c[3];
  Spectrum grey = constant(0.5, wavelengths), metamer = grey, bulb{wavelengths, {0, 1, 2, 3}};
  const double share = 0.4 / std::max({std::abs(black.x), std::abs(black.y), std::abs(black.z), 1.0});
  for (std::size_t i = 0; i < 4; ++i) metamer.values[i] += share * (i < 3 ? black[static_cast<int>(i)] : 1.0);
  const auto under = [](Spectrum paint, const Spectrum& light) {
    for (std::size_t i = 0; i < paint.values.size(); ++i) paint.values[i] *= light.values[i];
    return linearSrgb(paint);
  };
  for (int channel = 0; channel < 3; ++channel) CHECK(reflectanceColour(metamer)[channel] == Approx(0.5).margin(1e-12));
  CHECK(glm::length(under(metamer, bulb) - under(grey, bulb)) > 1e-3);
}
