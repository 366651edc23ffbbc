// Pieces of triangles fill the triangle, lie in their cells, and have the areas of rational arithmetic.
#include "radiosity/geometry/grid_clipping.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "raster/base/cross.h"

using namespace hemitex::radiosity;
using Grid = std::array<glm::dvec2, 3>;
using Rational = boost::multiprecision::cpp_rational;

namespace {

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * (double(random()) / 4294967296.0);
}

Grid randomTriangle(std::mt19937& random, double size) {
  Grid grid;
  for (glm::dvec2& corner : grid) corner = {uniform(random, 0, size), uniform(random, 0, size)};
  return grid;
}

struct ExactPoint {
  Rational x, y;
};

/// The part of a polygon where distance(point) >= 0.
template <typename Distance>
std::vector<ExactPoint> clipped(const std::vector<ExactPoint>& polygon, const Distance& distance) {
  std::vector<ExactPoint> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ExactPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational fa = distance(a), fb = distance(b);
    if (fa >= 0) result.push_back(a);
    if ((fa < 0 && fb > 0) || (fa > 0 && fb < 0)) {
      const Rational t = fa / (fa - fb);
      result.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return result;
}

Rational doubledArea(const std::vector<ExactPoint>& polygon) {
  Rational sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ExactPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

/// The share of the triangle inside one cell, clipped against that cell alone, without rounding.
double exactShare(const Grid& grid, std::int64_t column, std::int64_t row) {
  std::vector<ExactPoint> polygon;
  for (const glm::dvec2& corner : grid) polygon.push_back({Rational(corner.x), Rational(corner.y)});
  const Rational whole = doubledArea(polygon);
  polygon = clipped(polygon, [&](const ExactPoint& p) { return Rational(p.x - column); });
  polygon = clipped(polygon, [&](const ExactPoint& p) { return Rational(column + 1 - p.x); });
  polygon = clipped(polygon, [&](const ExactPoint& p) { return Rational(p.y - row); });
  polygon = clipped(polygon, [&](const ExactPoint& p) { return Rational(row + 1 - p.y); });
  return Rational(doubledArea(polygon) / whole).convert_to<double>();
}

}  // namespace

TEST_CASE("forEachCell gives the shares of rational arithmetic, cell by cell", "[clipping]") {
  // The weights of a corner have an error of a few roundoffs of 1 (2^-53 = 1.1e-16), and so do shares.
  std::mt19937 random(1);
  double worst = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Grid grid = randomTriangle(random, 6);
    if (trial % 3 == 1) grid[2] = grid[0] + 0.4 * (grid[1] - grid[0]) + 1e-7;  // a sliver
    if (trial % 3 == 2)
      for (glm::dvec2& corner : grid) corner = glm::round(corner);  // corners on lines
    if (raster::cross(grid[1] - grid[0], grid[2] - grid[0]) == 0) continue;
    std::array<std::array<double, 8>, 8> shares{};
    forEachCell(grid, [&](std::int64_t column, std::int64_t row, const Piece& piece) {
      shares.at(std::size_t(row)).at(std::size_t(column)) += share(piece);
    });
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 8; ++column)
        worst =
            std::max(worst, std::abs(shares[std::size_t(row)][std::size_t(column)] - exactShare(grid, column, row)));
  }
  // The sliver's area in cells depends on its rounded corners, not on the clipping: both methods use the same corners.
  CHECK(worst < 2e-15);
}

TEST_CASE("forEachCell gives pieces that lie in their cells and fill the triangle", "[clipping]") {
  std::mt19937 random(2);
  const auto isIn = [](double x, std::int64_t cell) { return x >= double(cell) && x <= double(cell + 1); };
  for (const double size : {0.3, 3.0, 70.0})
    for (int trial = 0; trial < 300; ++trial) {
      Grid grid = randomTriangle(random, size);
      if (trial % 4 == 1) grid[1] = grid[0] + 1e-9 * grid[1];             // short and thin
      if (trial % 4 == 2) grid[2].y = grid[1].y = std::floor(grid[0].y);  // an edge on a line
      if (trial % 4 == 3) grid[2] = grid[0] + 0.5 * (grid[1] - grid[0]);  // no area except for rounding
      double sum = 0;
      bool inside = true;
      forEachCell(grid, [&](std::int64_t column, std::int64_t row, const Piece& piece) {
        sum += share(piece);
        for (std::size_t k = 0; k < piece.size; ++k)
          inside &= isIn(piece.corners[k].grid.x, column) && isIn(piece.corners[k].grid.y, row);
      });
      CHECK(inside);
      CHECK(std::abs(sum - 1) < 1e-13);
    }
}

TEST_CASE("forEachCell visits one cell at a time for a triangle that lies on a line or in a point", "[clipping]") {
  // Without area on the grid, the weights still give the shares; nothing is counted twice.
  const std::array<Grid, 4> collapsed{Grid{glm::dvec2(1, 1), glm::dvec2(1, 1), glm::dvec2(1, 1)},
                                      Grid{glm::dvec2(0, 2), glm::dvec2(3, 2), glm::dvec2(5, 2)},
                                      Grid{glm::dvec2(2, 0), glm::dvec2(2, 4), glm::dvec2(2, 1)},
                                      Grid{glm::dvec2(0, 0), glm::dvec2(3, 3), glm::dvec2(4, 4)}};
  for (const Grid& grid : collapsed) {
    double sum = 0;
    forEachCell(grid, [&](std::int64_t, std::int64_t, const Piece& piece) { sum += share(piece); });
    CHECK(sum == Approx(1).margin(1e-15));
  }
}

TEST_CASE("clippedToCell gives the piece that forEachCell gives", "[clipping]") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Grid grid = randomTriangle(random, 9);
    double worst = 0;
    forEachCell(grid, [&](std::int64_t column, std::int64_t row, const Piece& piece) {
      worst = std::max(worst, std::abs(share(piece) - share(clippedToCell(grid, column, row))));
    });
    CHECK(worst < 1e-15);
    CHECK(clippedToCell(grid, 20, 3).size == 0);
  }
}

TEST_CASE("centroid of a whole triangle weights its corners equally", "[clipping]") {
  const glm::dvec2 weights = centroid(wholeTriangle({glm::dvec2(0, 0), glm::dvec2(5, 1), glm::dvec2(2, 7)}));
  CHECK(weights.x == Approx(1.0 / 3).epsilon(1e-15));
  CHECK(weights.y == Approx(1.0 / 3).epsilon(1e-15));
  // The unit square at the right angle of a triangle with legs of 2: its middle has the weights 1/4.
  const glm::dvec2 corner = centroid(clippedToCell({glm::dvec2(0, 0), glm::dvec2(2, 0), glm::dvec2(0, 2)}, 0, 0));
  CHECK(corner.x == Approx(0.25).epsilon(1e-15));
  CHECK(corner.y == Approx(0.25).epsilon(1e-15));
  // The trapezoid y < 1 - x/2, x < 1: area 3/4, x = (1/2 - 1/6) / (3/4) = 4/9, y = (1 - 1/2 + 1/12) / 2 / (3/4) = 7/18.
  const glm::dvec2 trapezoid = centroid(clippedToCell({glm::dvec2(0, 0), glm::dvec2(2, 0), glm::dvec2(0, 1)}, 0, 0));
  CHECK(trapezoid.x == Approx(2.0 / 9).epsilon(1e-15));
  CHECK(trapezoid.y == Approx(7.0 / 18).epsilon(1e-15));
}

TEST_CASE("weightsAt finds a point on the edge of two triangles in at least one of them", "[clipping]") {
  std::mt19937 random(4);
  for (int trial = 0; trial < 20000; ++trial) {
    const glm::dvec2 a{uniform(random, 0, 1), uniform(random, 0, 1)}, b{uniform(random, 0, 1), uniform(random, 0, 1)};
    const glm::dvec2 side(b.y - a.y, a.x - b.x);
    const glm::dvec2 left = a - side, right = b + side;
    const glm::dvec2 point = a + uniform(random, 0.01, 0.99) * (b - a);
    const bool isInLeft = weightsAt({a, b, left}, point).has_value();
    const bool isInRight = weightsAt({b, a, right}, point).has_value();
    const bool isInMirrored = weightsAt({a, b, right}, point).has_value();
    REQUIRE((isInLeft || isInRight));
    REQUIRE(isInRight == isInMirrored);
  }
}

TEST_CASE("weightsAt gives weights that reproduce the point, and none outside or without area", "[clipping]") {
  const Grid grid{glm::dvec2(1, 2), glm::dvec2(7, 3), glm::dvec2(2, 9)};
  const auto weights = weightsAt(grid, {3, 4});
  REQUIRE(weights);
  const glm::dvec2 back = grid[0] + weights->x * (grid[1] - grid[0]) + weights->y * (grid[2] - grid[0]);
  CHECK(glm::length(back - glm::dvec2(3, 4)) < 1e-15);
  for (const glm::dvec2& corner : grid) CHECK(weightsAt(grid, corner));
  CHECK_FALSE(weightsAt(grid, {1, 1.9}));
  CHECK_FALSE(weightsAt({glm::dvec2(0, 0), glm::dvec2(1, 1), glm::dvec2(2, 2)}, {1, 1}));
}
