// pointToPolygon compared with closed forms of rectangles, quadrature, and identities.
#include "reference/truth/closed_forms/point_to_polygon.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "tests/support/form_factor_quadrature.h"
#include "tests/truth/rectangles.h"

using namespace hemitex::reference;
using namespace hemitex::tests;

namespace {

const glm::dvec3 origin(0), up(0, 0, 1);

const std::vector<double> distances{1e-6, 1e-3, 0.1, 1, 30, 1e3, 1e4};
const std::vector<double> widths{1, 1e-3, 1e-6};
const std::vector<double> offsets{-0.5, 0, 1e-6, 3};
const std::vector<double> scales{1, 1e-6, 1e6};

AxisRectangle axisRectangle(double x0, double x1, double y0, double y1) { return {{x0, x1}, {y0, y1}}; }

Parallelogram ceilingOf(const AxisRectangle& r, double z) {
  return {{r.first.low, r.second.low, z}, {0, r.second.high - r.second.low, 0}, {r.first.high - r.first.low, 0, 0}};
}

/// (x, z) in the plane y = `y`, facing the origin.
Parallelogram wallOf(const AxisRectangle& r, double y) {
  return {{r.first.low, y, r.second.low}, {r.first.high - r.first.low, 0, 0}, {0, 0, r.second.high - r.second.low}};
}

double fromOrigin(const Parallelogram& to, const glm::dvec3& normal = up) {
  return pointToPolygon(origin, normal, to.corners());
}

/// The six faces of a box, facing inwards.
std::vector<Parallelogram> facesOf(const glm::dvec3& low, const glm::dvec3& size) {
  const glm::dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  return {{low, x, y}, {low + z, y, x}, {low, y, z}, {low + x, z, y}, {low, z, x}, {low + y, x, z}};
}

glm::dvec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> coordinate;
  const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
  return glm::normalize(glm::dvec3(x, y, z));
}

/// Coordinates with so few digits that their sums are exact.
glm::dvec3 rounded(const glm::dvec3& v) { return glm::round(std::ldexp(1.0, 45) * v) / std::ldexp(1.0, 45); }

glm::dvec3 randomPoint(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(0, 1);
  const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
  return {x, y, z};
}

}  // namespace

TEST_CASE("pointToPolygon equals the closed forms of rectangles, at all distances, widths, offsets and scales",
          "[form factors]") {
  double worst = 0;
  for (const double distance : distances)
    for (const double width : widths)
      for (const double offset : offsets)
        for (const double scale : scales) {
          const AxisRectangle parallel =
              axisRectangle(offset * scale, (offset + 1) * scale, -width / 3 * scale, width * scale);
          const AxisRectangle upright = axisRectangle(offset * scale, (offset + 1) * scale, 0, width * scale);
          const AxisRectangle raised = axisRectangle(offset * scale, (offset + 1) * scale, scale, (1 + width) * scale);
          const double d = distance * scale;
          worst = std::max({worst,
                            relativeError(fromOrigin(ceilingOf(parallel, d)), elementToParallelRectangle(parallel, d)),
                            relativeError(fromOrigin(wallOf(upright, d)), elementToPerpendicularRectangle(upright, d)),
                            relativeError(fromOrigin(wallOf(raised, d)), elementToPerpendicularRectangle(raised, d))});
        }
  CHECK(worst < 2e-10);
}

TEST_CASE("pointToPolygon clips the part below the horizon, however little is above it", "[form factors]") {
  double worst = 0;
  for (const double elevation : {1.0, 1e-3, 1e-6, 1e-9, 1e-11})
    for (const double distance : {1e-3, 1.0, 1e4})
      for (const double offset : offsets) {
        const double height = elevation * distance;
        const AxisRectangle above = axisRectangle(offset, offset + 1, 0, height);
        const std::vector<glm::dvec3> corners{{offset, distance, -1},
                                              {offset + 1, distance, -1},
                                              {offset + 1, distance, height},
                                              {offset, distance, height}};
        worst = std::max(worst, relativeError(pointToPolygon(origin, up, corners),
                                              elementToPerpendicularRectangle(above, distance)));
      }
  CHECK(worst < 2e-10);
}

TEST_CASE("pointToPolygon of a triangle with only its tip above the horizon is that of the tip", "[form factors]") {
  // Corners at z = -1 and a tip at z = h: the cut is at 1/(1 + h) of the sides. The corners of the clipped triangle are
  // rounded by 1e-16, relative to sides of about h.
  for (const double h : {1.0, 1e-3, 1e-6}) {
    const double t = h / (1 + h);
    const std::vector<glm::dvec3> whole{{-1, 2, -1}, {1, 2, -1}, {0, 2, h}}, tip{{-t, 2, 0}, {t, 2, 0}, {0, 2, h}};
    CHECK(relativeError(pointToPolygon(origin, up, whole), pointToPolygon(origin, up, tip)) < 1e-9);
    // The small tip is at a distance of 2, at a height of h/3 on average: area cos cos / (pi r^2).
    if (h < 1e-2)
      CHECK(relativeError(pointToPolygon(origin, up, tip), t * h * (h / 3 / 2) / (4 * std::numbers::pi)) < h * h);
  }
}

TEST_CASE("pointToPolygon of parallelograms of any slant equals quadrature", "[form factors]") {
  std::mt19937 random(1);
  double worst = 0;
  for (const double distance : {4.0, 100.0, 1e4})
    for (const double width : widths)
      for (int i = 0; i < 30; ++i) {
        const glm::dvec3 normal = randomDirection(random), towards = randomDirection(random);
        Parallelogram to{{}, rounded(randomDirection(random)), rounded(width * randomDirection(random))};
        if (glm::dot(to.areaVector(), towards) > 0) to = to.reversed();
        // The quadrature knows no horizon, and is inaccurate if the parallelogram is nearly edge-on or degenerate.
        if (glm::dot(normal, towards) < 0.3 || glm::dot(to.areaVector(), towards) > -0.1 * width) continue;
        const glm::dvec3 point = -distance * towards;
        worst =
            std::max(worst, relativeError(pointToPolygon(point, normal, to.corners()), bruteForce(point, normal, to)));
      }
  CHECK(worst < 2e-10);
}

TEST_CASE("pointToPolygon of the faces of a box sums to 1 from any point inside", "[form factors]") {
  std::mt19937 random(2);
  double worst = 0;
  for (const glm::dvec3& size : {glm::dvec3(1), glm::dvec3(1, 1e-3, 1), glm::dvec3(1, 1e3, 1e-3), glm::dvec3(1e6)})
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 low = -size * randomPoint(random), normal = randomDirection(random);
      double sum = 0;
      for (const Parallelogram& face : facesOf(low, size)) sum += fromOrigin(face, normal);
      worst = std::max(worst, std::abs(sum - 1));
    }
  CHECK(worst < 1e-12);
}

TEST_CASE("pointToPolygon from the floor of a box sees its walls and ceiling, and no coplanar faces",
          "[form factors]") {
  for (const glm::dvec2& at : {glm::dvec2(0.5, 0.5), glm::dvec2(1e-6, 0.3), glm::dvec2(1 - 1e-9, 1e-12)}) {
    double sum = 0;
    for (const Parallelogram& face : facesOf({-at.x, -at.y, 0}, glm::dvec3(1))) sum += fromOrigin(face);
    CHECK(std::abs(sum - 1) < 1e-12);
    CHECK(fromOrigin(facesOf({-at.x, -at.y, 0}, glm::dvec3(1)).front()) == 0);
  }
}

TEST_CASE("pointToPolygon of a polygon is the sum of its parts, for any first corner", "[form factors]") {
  const Parallelogram to{{-0.4, 0.3, -0.2}, {1, 0.5, 0.25}, {-0.5, 1, 1}};
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-0.2, 0.4, 1)), point(0.1, 0.2, -2);
  const double whole = pointToPolygon(point, normal, to.reversed().corners());
  REQUIRE(whole > 0.04);
  double parts = 0;
  for (const double start : {0.0, 0.25})
    parts += pointToPolygon(
        point, normal, Parallelogram{to.at(start, 0), (start > 0 ? 0.75 : 0.25) * to.u, to.v}.reversed().corners());
  CHECK(relativeError(parts, whole) < 1e-13);
  std::vector<glm::dvec3> corners = to.reversed().corners();
  std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  CHECK(relativeError(pointToPolygon(point, normal, corners), whole) < 1e-13);
}

TEST_CASE("pointToPolygon from a point almost in a polygon is 1", "[form factors]") {
  // On the axis of a square of half side 1 the difference from 1 is below that of the inscribed disk: h^2 / (1 + h^2).
  for (const double height : {1e-3, 1e-6, 1e-12}) {
    const double seen = fromOrigin(ceilingOf(axisRectangle(-1, 1, -1, 1), height));
    CHECK(seen <= 1);
    CHECK(seen >= 1 - height * height - 1e-15);
  }
}

TEST_CASE("pointToPolygon is 0 for a polygon edge-on, behind the point, or facing away", "[form factors]") {
  const Parallelogram wall = wallOf(axisRectangle(-1, 1, 0, 1), 1);
  CHECK(fromOrigin(wall) > 0);
  CHECK(fromOrigin(wall.reversed()) == 0);
  CHECK(fromOrigin(wall, -up) == 0);
  CHECK(pointToPolygon({-3, 1, 0}, up, wall.corners()) == 0);     // in its plane, beside it
  CHECK(pointToPolygon({0.3, 1, 0}, up, wall.corners()) == 0);    // on its edge
  CHECK(pointToPolygon({-1, 1, 0}, up, wall.corners()) == 0);     // on its corner
  CHECK(pointToPolygon({0.3, 1, 0.5}, up, wall.corners()) == 0);  // inside it
  CHECK(pointToPolygon({0.3, 1, 0.5}, {0, -1, 0}, wall.corners()) == 0);
}

TEST_CASE("pointToPolygon is 0 for a polygon in the horizon, for any rounding of its slant", "[form factors]") {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 normal = randomDirection(random), u = glm::normalize(glm::cross(normal, randomDirection(random)));
    const Parallelogram level{3.0 * u, 0.5 * u, glm::cross(normal, u)};
    CHECK(fromOrigin(level, normal) == 0);
    CHECK(fromOrigin(level.reversed(), normal) == 0);
  }
}

TEST_CASE("pointToPolygon near an upright polygon's edge tends to one half", "[form factors]") {
  // An infinite wall gives one half at any distance. A wall from -1 to 1 of height 1 misses about the distance.
  const Parallelogram wall = wallOf(axisRectangle(-1, 1, 0, 1), 1);
  for (const double gap : {1e-3, 1e-9, 1e-15}) {
    const double seen = pointToPolygon({0.3, 1 - gap, 0}, up, wall.corners());
    CHECK(seen < 0.5);
    CHECK(seen > 0.5 - 2 * gap - 1e-15);
  }
}

TEST_CASE("pointToPolygon keeps a given absolute error, and avoids arithmetic with many digits", "[form factors]") {
  // A triangle of a square that hangs low over the point, seen from under the other half: small and inaccurate.
  for (const double gap : {1e-2, 1e-4, 1e-6})
    for (const double allowed : {1e-13, 1e-10, 1e-7})
      for (int i = 0; i < 20; ++i) {
        const glm::dvec3 point(0.05 * i, 0.4, 0);
        const std::vector<glm::dvec3> half{{0, 0, gap}, {0, 1, gap}, {1, 1, gap}};
        const double exact = pointToPolygon(point, up, half);
        CHECK(std::abs(pointToPolygon(point, up, half, allowed) - exact) <= allowed + 1e-9 * exact);
      }
}
