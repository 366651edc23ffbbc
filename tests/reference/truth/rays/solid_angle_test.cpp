// Directions into polygons: known solid angles, uniform density, and an average with a closed form.
#include "reference/truth/rays/solid_angle.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "reference/truth/closed_forms/point_to_polygon.h"
#include "reference/truth/rays/sample_points.h"

using namespace hemitex::reference;

namespace {

struct RandomDirections {
  std::mt19937 bits{11};
  double uniform(double low, double high) { return low + (high - low) * double(bits()) / 4294967296.0; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 p{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (glm::dot(p, p) <= 1 && glm::dot(p, p) > 1e-3) return glm::normalize(p);
    }
  }
};

/// The distance of a direction outside the planes through the origin and the edges; 0 inside.
double outside(const SphericalTriangle& triangle, const glm::dvec3& direction) {
  const double winding = glm::dot(triangle[0], glm::cross(triangle[1], triangle[2])) > 0 ? 1 : -1;
  double distance = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 plane = glm::normalize(glm::cross(triangle[k], triangle[(k + 1) % 3]));
    distance = std::max(distance, -winding * glm::dot(plane, direction));
  }
  return distance;
}

}  // namespace

TEST_CASE("solidAngle equals the values known by symmetry", "[solid angle]") {
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(solidAngle({x, y, z}) == Approx(M_PI / 2).epsilon(1e-15));  // an eighth of the sphere
  CHECK(solidAngle({x, z, y}) == Approx(M_PI / 2).epsilon(1e-15));
  CHECK(solidAngle({x, glm::normalize(x + y), z}) == Approx(M_PI / 4).epsilon(1e-15));
  // A small triangle is flat: half the product of its legs.
  CHECK(solidAngle({z, glm::normalize(z + 1e-5 * x), glm::normalize(z + 1e-5 * y)}) == Approx(0.5e-10).epsilon(1e-9));
}

TEST_CASE("directionIn fills a spherical triangle uniformly", "[solid angle]") {
  // The triangle is cut from the first corner to a point of the opposite side. Each part gets its share of a net of
  // 2^12 points, except for points on a cut that crosses the net. Large triangles, small ones and slivers.
  RandomDirections random;
  const SamplePoints points(1 << 12, 3);
  for (std::size_t repeat = 0; repeat < 60; ++repeat) {
    const double size = std::pow(10.0, random.uniform(-3, 0)), width = std::pow(10.0, random.uniform(-3, 0));
    const glm::dvec3 a = random.direction(), side = random.direction();
    const glm::dvec3 b = glm::normalize(a + size * side),
                     c = glm::normalize(a + size * (0.5 * side + width * random.direction()));
    const SphericalTriangle whole{a, b, c};
    if (solidAngle(whole) < 1e-6) continue;
    INFO("solid angle " << solidAngle(whole) << ", width " << width);
    for (std::size_t turn = 0; turn < 3; ++turn) {
      const SphericalTriangle turned{whole[turn], whole[(turn + 1) % 3], whole[(turn + 2) % 3]};
      for (std::size_t cut = 0; cut < 3; ++cut) {
        const glm::dvec3 apex = whole[cut], p = whole[(cut + 1) % 3], q = whole[(cut + 2) % 3];
        const SphericalTriangle part{apex, p, glm::normalize(p + 0.4 * (q - p))};
        int inside = 0;
        double farthest = 0;
        for (std::size_t i = 0; i < points.count(); ++i) {
          const SamplePoint point = points.at(repeat % sampleBlocks, i);
          const glm::dvec3 direction = directionIn(turned, point[0], point[1]);
          farthest = std::max(farthest, outside(whole, direction));
          inside += outside(part, direction) == 0;
        }
        CHECK(farthest < 1e-12);
        CHECK(inside / 4096.0 == Approx(solidAngle(part) / solidAngle(whole)).margin(0.01));
      }
    }
  }
}

TEST_CASE("aimInto gives directions into a polygon whose mean cosine is its form factor", "[solid angle]") {
  // F = 1/pi times the integral of the cosine over the polygon's solid angle, from Lambert's formula. Near, far, large,
  // small and thin polygons, sampled by solid angle and by area.
  RandomDirections random;
  const SamplePoints points(1 << 14, 0);
  int byArea = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const double height = std::pow(10.0, random.uniform(-3, 5)), size = std::pow(10.0, random.uniform(-3, 0.5));
    std::vector<glm::dvec3> polygon;
    const int corners = 3 + repeat % 5;
    for (int k = 0; k < corners; ++k) {  // clockwise from above, which is counter-clockwise from below
      const double angle = -2 * M_PI * (k + 0.3) / corners;
      polygon.emplace_back(0.3 + size * std::cos(angle), 0.2 + 0.6 * size * std::sin(angle), height);
    }
    const glm::dvec3 point(0), normal = glm::normalize(glm::dvec3(0.2, -0.1, 1));
    double sum = 0, farthest = 0;  // distance outside the polygon, relative to its size
    for (std::size_t i = 0; i < points.count(); ++i) {
      const SamplePoint sample = points.at(0, i);
      const Aim aim = aimInto(polygon, point, sample[0], sample[1]);
      sum += std::max(0.0, glm::dot(aim.direction, normal)) * aim.solidAngle / M_PI;
      byArea += aim.solidAngle < 1e-6;
      const glm::dvec3 met = aim.direction * (height / aim.direction.z);
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec3 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
        farthest = std::max(farthest, glm::cross(edge, met - polygon[k]).z / glm::length(edge) / size);
      }
    }
    INFO("height " << height << ", size " << size);
    CHECK(farthest < 1e-14 * (height + 1) / size + 1e-9);
    CHECK(sum / 16384 == Approx(pointToPolygon(point, normal, polygon)).epsilon(3e-4));
  }
  CHECK(byArea > 0);
}

TEST_CASE("aimInto gives directions inside a sliver, however near it is", "[solid angle]") {
  // Half a strip of length 1, as far away as it is wide: it fills a tenth of all directions, and its ends are almost
  // opposite. A ray along its border could meet the other half.
  const SamplePoints points(1 << 14, 0);
  for (const double width : {1e-3, 1e-6, 1e-8}) {
    const std::vector<glm::dvec3> sliver{{-0.3, -width, width}, {0.7, width, width}, {0.7, -width, width}};
    int inside = 0;
    for (std::size_t i = 0; i < points.count(); ++i) {
      const SamplePoint sample = points.at(0, i);
      const Aim aim = aimInto(sliver, glm::dvec3(0, 0.1 * width, 0), sample[0], sample[1]);
      const glm::dvec2 met = glm::dvec2(aim.direction) / aim.direction.z + glm::dvec2(0, 0.1);  // in widths
      inside += met.y > -1 && met.x * width < 0.7 && met.y < 2 * (met.x * width + 0.3) - 1;
    }
    INFO("width " << width);
    CHECK(inside == 1 << 14);
  }
}
