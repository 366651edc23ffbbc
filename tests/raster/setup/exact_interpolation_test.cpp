// The exact decisions compared with the same formulas in unbounded integers, sample by sample.
#include "raster/setup/exact_interpolation.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

/// docs/item-buffers.md, "depth", literally.
Rational inverseDepth(const ScreenTriangle& triangle, int column, int row) {
  Rational sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += Rational(triangle.edges[k].at(column, row)) / Rational(triangle.area) / Rational(triangle.w[k]);
  return sum;
}

Rational coordinateAt(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int column, int row) {
  Rational sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += Rational(triangle.edges[k].at(column, row)) / Rational(triangle.area) * Rational(coordinate[k]) /
           Rational(triangle.w[k]);
  return sum / inverseDepth(triangle, column, row);
}

int texelByRules(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int size, int column,
                 int row) {
  const Rational position = coordinateAt(triangle, coordinate, column, row) * size;
  if (position < 0) return 0;
  const Integer whole = numerator(position) / denominator(position);
  return whole >= size ? size - 1 : static_cast<int>(whole);
}

int texelOf(const ExactQuotient& exact, const ScreenTriangle& triangle, int size, int column, int row) {
  double numerator = 0, denominator = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto edge = static_cast<double>(triangle.edges[k].at(column, row));
    numerator += edge * exact.numerator[k];
    denominator += edge * exact.denominator[k];
  }
  return static_cast<int>(std::clamp(std::floor(numerator / denominator), 0.0, size - 1.0));
}

/// The number of bits of the values: few, all of binary32, or all of double precision as after clipping.
enum class Digits { Few, Single, Double };

double number(std::mt19937& random, Digits digits, float low, float high) {
  const double value = tests::uniform(random, low, high);
  if (digits == Digits::Few) return std::nearbyint(value * 16) / 16;
  return digits == Digits::Single ? value : value + 0x1p-30 * value * tests::uniform(random, 0.0F, 1.0F);
}

struct Sample {
  int column, row;
};

/// Three samples inside a triangle or on its edges; none if it covers fewer.
std::vector<Sample> samplesOf(const ScreenTriangle& triangle, std::mt19937& random) {
  std::vector<Sample> samples;
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column)
      if (std::all_of(triangle.edges.begin(), triangle.edges.end(),
                      [&](const Edge& edge) { return edge.at(column, row) >= 0; }))
        samples.push_back({column, row});
  if (samples.size() < 3) return {};
  std::shuffle(samples.begin(), samples.end(), random);
  samples.resize(3);
  return samples;
}

struct Kind {
  const char* name;
  Digits digits;
  bool straight;      ///< one w for all corners
  float depths;       ///< ratio of the largest to the smallest depth
  float coordinates;  ///< largest absolute value of u and v
  bool isShort;       ///< some quotients fit into double precision
};

const std::vector<Kind> kinds = {{"a wall of round numbers, straight on", Digits::Few, true, 1, 2, true},
                                 {"a floor of round numbers", Digits::Few, false, 4, 2, true},
                                 {"a wall, straight on", Digits::Single, true, 3, 1, false},
                                 {"a floor", Digits::Single, false, 3, 1, false},
                                 {"a wall that was clipped", Digits::Double, true, 3, 1, false},
                                 {"a floor that was clipped", Digits::Double, false, 3, 1, false},
                                 {"depths from near to far", Digits::Double, false, 1e9F, 1, false},
                                 {"wide coordinates", Digits::Single, false, 3, 1e12F, false}};

/// A triangle of a kind. `columns` receives the snapped columns of its corners, from 0 to 1 across the picture.
ScreenTriangle randomTriangle(std::mt19937& random, const Kind& kind, std::array<double, 3>* columns = nullptr) {
  const Face face = tests::frontFace(32);
  ScreenTriangle triangle;
  const float least = 0.5F;
  const double common = number(random, kind.digits, least, least * 3);
  std::array<ViewVertex, 3> vertices;
  do {
    for (ViewVertex& vertex : vertices) {
      const double scale = std::pow(kind.depths, tests::uniform(random, 0.0F, 1.0F));
      vertex.w = kind.straight ? common : number(random, kind.digits, least, least + static_cast<float>(scale));
      vertex.x = number(random, kind.digits, -1, 1) * vertex.w;
      vertex.y = number(random, kind.digits, -1, 1) * vertex.w;
      vertex.u = number(random, kind.digits, -kind.coordinates, kind.coordinates);
      vertex.v = number(random, kind.digits, 0, 1);
    }
  } while (!makeScreenTriangle(face, vertices, false, triangle));
  for (std::size_t k = 0; k < 3 && columns != nullptr; ++k)
    (*columns)[k] = static_cast<double>(snap(vertices[k].x / vertices[k].w, face.resolution)) / 0x1p13;
  return triangle;
}

}  // namespace

TEST_CASE("texelExactly gives the texel of the definition, for all kinds of numbers", "[exact]") {
  std::mt19937 random(2002);
  for (const Kind& kind : kinds) {
    INFO(kind.name);
    int samples = 0, wrong = 0, quotients = 0, wrongQuotients = 0;
    for (int t = 0; t < 60; ++t) {
      ScreenTriangle triangle = randomTriangle(random, kind);
      for (const Sample& s : samplesOf(triangle, random))
        for (const int size : {1, 64, 100, 4096})
          for (const auto& coordinate : {triangle.u, triangle.v}) {
            const int expected = texelByRules(triangle, coordinate, size, s.column, s.row);
            ++samples;
            wrong += texelExactly(triangle, coordinate, size, s.column, s.row) != expected;
            const auto exact = exactQuotient(triangle, coordinate, size);
            quotients += exact.has_value();
            if (exact) wrongQuotients += texelOf(*exact, triangle, size, s.column, s.row) != expected;
          }
    }
    CHECK(samples > 1000);
    CHECK(wrong == 0);
    CHECK(wrongQuotients == 0);
    if (kind.isShort) CHECK(quotients > samples / 2);
    if (kind.digits == Digits::Double) CHECK(quotients < samples / 2);
  }
}

// Texels of half a pixel whose borders lie on samples, and a coordinate that is on the same border everywhere.
TEST_CASE("texelExactly gives a sample on a border the texel that begins there", "[exact]") {
  std::mt19937 random(11);
  int wrong = 0, samples = 0;
  for (const Kind& kind : kinds)
    for (int t = 0; t < 100; ++t) {
      std::array<double, 3> columns;
      const ScreenTriangle triangle = randomTriangle(random, kind, &columns);
      for (const Sample& s : samplesOf(triangle, random)) {
        ++samples;
        wrong += texelExactly(triangle, {0.25, 0.25, 0.25}, 64, s.column, s.row) != 16;
        if (kind.straight) wrong += texelExactly(triangle, columns, 64, s.column, s.row) != 2 * s.column + 1;
        if (!kind.isShort) continue;
        const auto exact = exactQuotient(triangle, {0.25, 0.25, 0.25}, 64);
        wrong += !exact || texelOf(*exact, triangle, 64, s.column, s.row) != 16;
        if (!kind.straight) continue;
        const auto along = exactQuotient(triangle, columns, 64);
        wrong += !along || texelOf(*along, triangle, 64, s.column, s.row) != 2 * s.column + 1;
      }
    }
  CHECK(samples > 1000);
  CHECK(wrong == 0);
}

// A coordinate is shifted so that a sample of the triangle is as near to a texel border as double precision allows: its
// rounded value there is subtracted.
TEST_CASE("texelExactly decides texels next to borders", "[exact]") {
  std::mt19937 random(17);
  int below = 0, above = 0, wrong = 0;
  for (const Kind& kind : kinds) {
    if (kind.coordinates > 2) continue;
    for (int t = 0; t < 200; ++t) {
      const ScreenTriangle triangle = randomTriangle(random, kind);
      for (const Sample& s : samplesOf(triangle, random)) {
        std::array<double, 3> coordinate = triangle.u;
        const auto value = static_cast<double>(coordinateAt(triangle, coordinate, s.column, s.row));
        for (double& at : coordinate) at += 0.25 - value;
        const Rational beyond = coordinateAt(triangle, coordinate, s.column, s.row) * 64 - 16;
        below += beyond < 0 && beyond > -Rational(1, 1LL << 40);
        above += beyond > 0 && beyond < Rational(1, 1LL << 40);
        wrong += texelExactly(triangle, coordinate, 64, s.column, s.row) != (beyond < 0 ? 15 : 16);
      }
    }
  }
  CHECK(below > 1000);
  CHECK(above > 1000);
  CHECK(wrong == 0);
}

TEST_CASE("isNearerExactly finds the nearer of two triangles, and equal depths are a tie", "[exact]") {
  std::mt19937 random(5);
  int ties = 0, nearer = 0, wrong = 0;
  const auto compare = [&](const ScreenTriangle& a, const ScreenTriangle& b, int column, int row) {
    const Rational depthA = inverseDepth(a, column, row), depthB = inverseDepth(b, column, row);
    ties += depthA == depthB;
    nearer += depthA > depthB;
    wrong += isNearerExactly(a, b, column, row) != (depthA > depthB);
    wrong += isNearerExactly(b, a, column, row) != (depthB > depthA);
  };
  for (const Kind& kind : kinds)
    for (int t = 0; t < 50; ++t) {
      const ScreenTriangle triangle = randomTriangle(random, kind), other = randomTriangle(random, kind);
      // The same corners in another order, one of them with another depth, and all with one depth.
      ScreenTriangle reversed = triangle, moved = triangle, straight = triangle;
      std::swap(reversed.edges[0], reversed.edges[2]);
      std::swap(reversed.w[0], reversed.w[2]);
      moved.w[t % 3] = std::nextafter(moved.w[t % 3], 9.0);
      straight.w.fill(triangle.w[0]);
      for (const Sample& s : samplesOf(triangle, random)) {
        compare(triangle, other, s.column, s.row);
        compare(triangle, reversed, s.column, s.row);
        compare(triangle, moved, s.column, s.row);
        compare(triangle, straight, s.column, s.row);
      }
    }
  CHECK(ties > 1000);
  CHECK(nearer > 1000);
  CHECK(wrong == 0);
}
