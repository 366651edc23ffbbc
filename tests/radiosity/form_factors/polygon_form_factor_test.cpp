/// The closed form of a polygon compared with that of reference/truth, which uses the library's arctangent.
#include "radiosity/form_factors/polygon_form_factor.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "reference/truth/closed_forms/point_to_polygon.h"

using namespace hemitex;

TEST_CASE("pointToPolygon is the reference's closed form, also across the horizon and near the corners",
          "[form-factors]") {
  std::mt19937 random(7);
  const auto coordinate = [&] { return static_cast<double>(random()) / 0x1p31 - 1; };
  for (int i = 0; i < 20000; ++i) {
    const double size = i % 2 == 0 ? 1 : 0x1p-12;
    const glm::dvec3 corner(coordinate(), coordinate(), coordinate()),
        x = size * glm::dvec3(coordinate(), coordinate(), coordinate()),
        y = size * glm::dvec3(coordinate(), coordinate(), coordinate()),
        normal = glm::normalize(glm::dvec3(coordinate(), coordinate(), coordinate()));
    std::vector<glm::dvec3> quad{corner, corner + x, corner + x + y, corner + y};
    if (glm::dot(glm::cross(x, y), corner) > 0) quad = {quad[0], quad[3], quad[2], quad[1]};  // faces the origin
    const double expected = reference::pointToPolygon(glm::dvec3(0), normal, quad);
    CHECK(std::abs(radiosity::pointToPolygon(glm::dvec3(0), normal, quad) - expected) < 1e-14);
  }
}
