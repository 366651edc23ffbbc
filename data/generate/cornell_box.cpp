/// The Cornell box: a box with two blocks that was built, measured and photographed at Cornell University, with
/// published measurements (Cornell University Program of Computer Graphics, "Cornell Box Data",
/// www.graphics.cornell.edu/online/box/data.html). Lengths are in millimetres.
///
/// Kept as measured: the red wall, whose corners are up to 3.2 mm off a common plane, and the open front. Changed: the
/// light lies in the plane of the ceiling, so the ceiling has a hole for it. The blocks stand on the floor without
/// bottoms.
#include <cmath>

#include "data/generate/models.h"
#include "data/generate/shapes.h"
#include "data/generate/spectrum.h"

namespace hemitex::data {
namespace {

/// Reflectances of the three paints at 400, 404, ..., 700 nm.
constexpr Spectrum white{
    0.343, 0.445, 0.551, 0.624, 0.665, 0.687, 0.708, 0.723, 0.715, 0.71,  0.745, 0.758, 0.739, 0.767, 0.777, 0.765,
    0.751, 0.745, 0.748, 0.729, 0.745, 0.757, 0.753, 0.75,  0.746, 0.747, 0.735, 0.732, 0.739, 0.734, 0.725, 0.721,
    0.733, 0.725, 0.732, 0.743, 0.744, 0.748, 0.728, 0.716, 0.733, 0.726, 0.713, 0.74,  0.754, 0.764, 0.752, 0.736,
    0.734, 0.741, 0.74,  0.732, 0.745, 0.755, 0.751, 0.744, 0.731, 0.733, 0.744, 0.731, 0.712, 0.708, 0.729, 0.73,
    0.727, 0.707, 0.703, 0.729, 0.75,  0.76,  0.751, 0.739, 0.724, 0.73,  0.74,  0.737,
};

constexpr Spectrum green{
    0.092, 0.096, 0.098, 0.097, 0.098, 0.095, 0.095, 0.097, 0.095, 0.094, 0.097, 0.098, 0.096, 0.101, 0.103, 0.104,
    0.107, 0.109, 0.112, 0.115, 0.125, 0.14,  0.16,  0.187, 0.229, 0.285, 0.343, 0.39,  0.435, 0.464, 0.472, 0.476,
    0.481, 0.462, 0.447, 0.441, 0.426, 0.406, 0.373, 0.347, 0.337, 0.314, 0.285, 0.277, 0.266, 0.25,  0.23,  0.207,
    0.186, 0.171, 0.16,  0.148, 0.141, 0.136, 0.13,  0.126, 0.123, 0.121, 0.122, 0.119, 0.114, 0.115, 0.117, 0.117,
    0.118, 0.12,  0.122, 0.128, 0.132, 0.139, 0.144, 0.146, 0.15,  0.152, 0.157, 0.159,
};

constexpr Spectrum red{
    0.04,  0.046, 0.048, 0.053, 0.049, 0.05,  0.053, 0.055, 0.057, 0.056, 0.059, 0.057, 0.061, 0.061, 0.06,  0.062,
    0.062, 0.062, 0.061, 0.062, 0.06,  0.059, 0.057, 0.058, 0.058, 0.058, 0.056, 0.055, 0.056, 0.059, 0.057, 0.055,
    0.059, 0.059, 0.058, 0.059, 0.061, 0.061, 0.063, 0.063, 0.067, 0.068, 0.072, 0.08,  0.09,  0.099, 0.124, 0.154,
    0.192, 0.255, 0.287, 0.349, 0.402, 0.443, 0.487, 0.513, 0.558, 0.584, 0.62,  0.606, 0.609, 0.651, 0.612, 0.61,
    0.65,  0.638, 0.627, 0.62,  0.63,  0.628, 0.642, 0.639, 0.657, 0.639, 0.635, 0.642,
};

/// The light's diffuse reflectance is 0.78 at all wavelengths; its emission is given at four of them.
constexpr double lightReflectance = 0.78;
Spectrum lightEmission() { return piecewiseLinear({{400, 0.0}, {500, 8.0}, {600, 15.6}, {700, 18.4}}); }

/// The paints are given to three digits.
glm::dvec3 toFourDigits(const glm::dvec3& value) {
  const auto round = [](double x) { return std::nearbyint(x * 1e4) / 1e4; };
  return {round(value.x), round(value.y), round(value.z)};
}

Material painted(const std::string& name, const Spectrum& paint) {
  return {name, toFourDigits(bandReflectance(paint, lightEmission()))};
}

Group block(const std::string& name, const Polygon& top) {
  Group group{name, "white", sides(top, 0)};
  group.polygons.push_back(top);
  return group;
}

}  // namespace

Model cornellBox() {
  Model model;
  model.name = "cornell-box";
  model.about = {
      "The Cornell box, in millimetres, open at the front. Positions are those measured at the Cornell University",
      "Program of Computer Graphics (Cornell Box Data, www.graphics.cornell.edu/online/box/data.html).",
      "The red wall's corners miss a common plane by 3.2 mm, as measured. The light, in the ceiling's plane, is cut",
      "out of it. Written by hemitex_data.",
  };
  model.aboutMaterials = {
      "The paints and the light of the Cornell box, from the spectra measured at the Cornell University Program of",
      "Computer Graphics (Cornell Box Data, www.graphics.cornell.edu/online/box/data.html).",
      "Ke of the light is its spectrum, integrated from 400 to 700 nm against the CIE 1931 2-degree colour matching",
      "functions, in linear sRGB (D65), relative: an emission of 1 at all wavelengths has Y = 1.",
      "There is no white balance: the light is as warm as it was, x = 0.436, y = 0.418.",
      "Kd of a paint is, band by band, the linear sRGB of the light after one reflection over that of the light: exact",
      "for light reflected once, and 1 for a perfect reflector. No channel left [0, 1), so none was clamped.",
      "Written by hemitex_data.",
  };
  model.materials = {painted("white", white), painted("red", red), painted("green", green),
                     Material{"light", glm::dvec3{lightReflectance}, toFourDigits(linearSrgb(lightEmission()))}};

  const Polygon ceiling{{{556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0}}};
  const Polygon light{{{343, 548.8, 227}, {343, 548.8, 332}, {213, 548.8, 332}, {213, 548.8, 227}}};
  model.groups = {
      {"floor", "white", {{{{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}}}}},
      {"ceiling", "white", frame(ceiling, light)},
      {"wall-back", "white", {{{{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}}}}},
      {"wall-green", "green", {{{{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}}}}},
      {"wall-red", "red", {{{{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0}}}}},
      block("short-block", {{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}}),
      block("tall-block", {{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}}),
      {"light", "light", {light}},
  };
  // The film measures 0.025 behind a focal length of 0.035, so that the field of view is 2 atan(0.0125 / 0.035).
  model.view = {{278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 39.30764811610662};
  return model;
}

}  // namespace hemitex::data
