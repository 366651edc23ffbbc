#include "radiosity/pictures/tangent.h"

#include <cassert>
#include <numbers>

namespace hemitex::radiosity {
namespace {

/// Lambert's continued fraction, tan x = x / (1 - x^2 / (3 - x^2 / (5 - ...))), for x in [0, pi/4]. The error of
/// stopping at level k is about (x/2)^(2k) / k!^2, which is negligible for k = 10.
double tangentOfSmall(double x) {
  double denominator = 21;
  for (int odd = 19; odd >= 1; odd -= 2) denominator = odd - x * x / denominator;
  return x / denominator;
}

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

}  // namespace

double tangentOfDegrees(double degrees) {
  assert(degrees >= 0 && degrees < 90);
  return degrees <= 45 ? tangentOfSmall(radians(degrees)) : 1 / tangentOfSmall(radians(90 - degrees));
}

}  // namespace hemitex::radiosity
