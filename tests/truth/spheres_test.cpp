// Form factors to and from spheres, compared with integrals over directions.
#include "tests/truth/spheres.h"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "tests/support/form_factor_quadrature.h"

using namespace hemitex::tests;

namespace {

using Digits34 = boost::multiprecision::cpp_bin_float_quad;
using Digits100 = boost::multiprecision::cpp_bin_float_100;

/// The integral of the cosine over the directions to a sphere that the horizon cuts, over pi. A ring of directions at
/// an angle beta from the sphere's centre has cosines c + s cos(phi), with c = cos(theta) cos(beta) and s = sin(theta)
/// sin(beta). They are positive for cos(phi) > -c/s, where their integral is 2 (c phi + s sin(phi)).
double integralOverDirections(double radius, double distance, double cosine) {
  const Digits34 sinAlpha = Digits34(radius) / distance, cosTheta = cosine, sinTheta = sqrt(1 - cosTheta * cosTheta);
  const Digits34 halfPi = boost::math::constants::half_pi<Digits34>();
  const auto ring = [&](const Digits34& beta) -> Digits34 {
    const Digits34 c = cosTheta * cos(beta), s = sinTheta * sin(beta);
    if (c <= -s) return 0;
    const Digits34 phi = c >= s ? Digits34(2 * halfPi) : Digits34(acos(-c / s));
    return 2 * (c * phi + s * sin(phi)) * sin(beta);
  };
  // Rings nearer than the horizon are complete if the centre is above it, and empty if it is below.
  boost::math::quadrature::tanh_sinh<Digits34> rule(12, Digits34(1e-60));
  const Digits34 horizon = abs(asin(cosTheta)), alpha = asin(sinAlpha);
  const Digits34 whole = cosine > 0 ? Digits34(sin(horizon) * sin(horizon) * cosTheta * 2 * halfPi) : Digits34(0);
  const Digits34 middle = (horizon + alpha) / 2, half = (alpha - horizon) / 2;
  const Digits34 cut = half * rule.integrate([&](const Digits34& t) { return ring(middle + half * t); });
  return static_cast<double>((whole + cut) / (2 * halfPi));
}

const std::vector<double> ratios{1e-6, 1e-4, 0.01, 0.3, 0.9, 1 - 1e-9};

}  // namespace

TEST_CASE("elementToSphere above the horizon is the outline's form factor times the cosine", "[form factors]") {
  for (const double ratio : ratios)
    for (const double cosine : {1.0, 0.99, ratio})
      if (cosine >= ratio) CHECK(relativeError(elementToSphere(ratio, 1, cosine), ratio * ratio * cosine) < 1e-15);
  CHECK(elementToSphere(1e6, 2e6, 0.75) == elementToSphere(1e-6, 2e-6, 0.75));
}

TEST_CASE("elementToSphere of a sphere that the horizon cuts equals an integral over directions", "[form factors]") {
  double worst = 0;
  for (const double ratio : ratios)
    for (const double height : {1 - 1e-9, 0.9, 0.1, 0.0, -0.1, -0.9, -0.999, -1 + 1e-6})
      worst = std::max(worst, relativeError(elementToSphere(ratio, 1, height * ratio),
                                            integralOverDirections(ratio, 1, height * ratio)));
  CHECK(worst < 1e-13);
}

TEST_CASE("elementToSphere below the horizon is 0", "[form factors]") {
  CHECK(elementToSphere(1, 2, -0.5) == 0);
  CHECK(elementToSphere(1, 2, -1) == 0);
}

TEST_CASE("elementToSphere of a sphere that touches the element at a right angle is one half", "[form factors]") {
  // The missing part is a strip about as wide as sqrt(2 * 1e-12).
  CHECK(elementToSphere(1 - 1e-12, 1, 0) < 0.5);
  CHECK(elementToSphere(1 - 1e-12, 1, 0) > 0.5 - 1e-6);
}

TEST_CASE("sphereToCoaxialDisk equals the book's form factor, for all radii and distances", "[form factors]") {
  double worst = 0;
  for (const double radius : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double distance : {1e-6, 0.1, 1.0, 1e4, 1e6}) {
      const Digits100 ratio = Digits100(radius) / distance;
      const auto book = static_cast<double>((1 - 1 / sqrt(1 + ratio * ratio)) / 2);
      worst = std::max(worst, relativeError(sphereToCoaxialDisk(radius, distance), book));
    }
  CHECK(worst < 1e-15);
}

TEST_CASE("elementToSphere and sphereToCoaxialDisk satisfy reciprocity", "[form factors]") {
  // From the disk's points at a distance rho from the axis, the sphere's centre is h = sqrt(distance^2 + rho^2) away,
  // at a cosine of distance / h. Rings of 2 pi rho d rho add up to what the sphere of area 4 pi r^2 receives.
  for (const double radius : {0.5, 2.0})
    for (const double distance : {1.5, 1e4}) {
      const double sphere = 1;
      const auto ring = [&](double rho) {
        const double h = std::hypot(distance, rho);
        return rho * elementToSphere(sphere, h, distance / h);
      };
      const double fromDisk = boost::math::quadrature::gauss<double, 30>::integrate(ring, 0.0, radius);
      CHECK(relativeError(2 * sphere * sphere * sphereToCoaxialDisk(radius, distance), fromDisk) < 1e-12);
    }
}
