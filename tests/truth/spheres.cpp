#include "tests/truth/spheres.h"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cassert>
#include <cmath>

namespace hemitex::tests {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

}  // namespace

double elementToSphere(double radius, double distance, double cosine) {
  assert(0 < radius && radius < distance && std::abs(cosine) <= 1);
  const Wide sinAlpha = Wide(radius) / distance, cosTheta = cosine;
  if (cosTheta >= sinAlpha) return static_cast<double>(sinAlpha * sinAlpha * cosTheta);
  if (cosTheta <= -sinAlpha) return 0;
  const Wide cosAlpha = sqrt((1 - sinAlpha) * (1 + sinAlpha));
  const Wide w = sqrt((sinAlpha - cosTheta) * (sinAlpha + cosTheta));
  const Wide psi = atan2(w, cosAlpha), phi = atan2(w, Wide(-cosAlpha * cosTheta));
  const Wide sum = psi + phi * sinAlpha * sinAlpha * cosTheta - w * cosAlpha;
  return static_cast<double>(sum / boost::math::constants::pi<Wide>());
}

double sphereToCoaxialDisk(double radius, double distance) {
  assert(radius > 0 && distance > 0);
  const double h = std::hypot(radius, distance);
  return radius / h * (radius / (h + distance)) / 2;
}

}  // namespace hemitex::tests
