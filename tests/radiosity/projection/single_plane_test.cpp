// The single plane: delta form factors compared with closed forms, and the captured share.
#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/projection/projection_kinds.h"
#include "tests/support/corner_form_factors.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::pixel;
using tests::toParallel;

TEST_CASE("singlePlane captures the form factor of its square", "[plane]") {
  // Four corners of toParallel(t, t) are 4/pi c atan(c), c = t / sqrt(1 + t^2). Each pixel is rounded by up to half a
  // unit of 2^-60; the quadrature is accurate to 1e-14.
  for (const int resolution : {2, 10, 64, 256})
    for (const double halfWidth : {1.0, 2.0, 3.5, 4.0, 16.0}) {
      const Projection plane = singlePlane(resolution, halfWidth);
      const double c = halfWidth / std::sqrt(1 + halfWidth * halfWidth);
      INFO("R = " << resolution << ", t = " << halfWidth);
      CHECK(formFactor(plane.captured) == Approx(4 / M_PI * c * std::atan(c)).epsilon(1e-13));
      CHECK(4 * toParallel(halfWidth, halfWidth) == Approx(4 / M_PI * c * std::atan(c)).epsilon(1e-13));
      CHECK(plane.sharesBefore[0].back() == plane.captured);
    }
}

TEST_CASE("singlePlane has the closed integrals over its pixels as delta form factors", "[plane]") {
  for (const int resolution : {2, 16, 128}) {
    const Projection plane = singlePlane(resolution);
    const auto edge = [resolution](int i) { return planeHalfWidth * (2.0 * i / resolution - 1); };
    bool holds = true;
    for (int j = 0; j < resolution; ++j)
      for (int i = 0; i < resolution; ++i) {
        const double exact = pixel(toParallel, edge(i), edge(i + 1), edge(j), edge(j + 1));
        // Four terms below 1/4, each accurate to about 1e-16.
        holds &= std::abs(formFactor(shareOf(plane, 0, i, j)) - exact) <= 1e-14 * exact + 4e-16;
      }
    INFO("R = " << resolution);
    CHECK(holds);
  }
}

TEST_CASE("singlePlane sees points within its half width, up to its reach", "[plane]") {
  const Projection plane = singlePlane(64);
  const auto faces = facesOver(plane.faces, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.1);
  REQUIRE(faces.size() == 1);
  // The corner of the square, whose squared distance is the squared reach.
  const glm::dvec3 corner(planeHalfWidth, planeHalfWidth, 1);
  CHECK(glm::dot(glm::dvec3(faces[0].x), corner) == 1);
  CHECK(glm::dot(glm::dvec3(faces[0].y), corner) == 1);
  CHECK(glm::dot(corner, corner) == plane.squaredReach);
}
