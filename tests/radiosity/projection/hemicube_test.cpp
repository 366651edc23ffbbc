// The hemicube: delta form factors compared with closed forms, and faces that partition the half space.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "radiosity/projection/projection_kinds.h"
#include "tests/support/corner_form_factors.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::pixel;
using tests::toParallel;
using tests::toPerpendicular;

TEST_CASE("hemicube has delta form factors on its five faces that sum to exactly one", "[hemicube]") {
  for (const int resolution : {2, 4, 6, 10, 30, 32, 64, 100, 128, 254, 256, 512, 1024}) {
    const Projection projection = hemicube(resolution);
    std::uint64_t total = 0;
    for (const ProjectionFace& face : projection.faces) total += projection.sharesBefore[face.shares].back();
    INFO("resolution " << resolution);
    CHECK(total == wholeShare);
    CHECK(projection.captured == wholeShare);
  }
}

TEST_CASE("deltaFormFactors has the shares of a face row by row, from the first of its scissor rectangle",
          "[hemicube]") {
  const Projection projection = hemicube(8);
  const std::vector<double> top = deltaFormFactors(projection, 0), side = deltaFormFactors(projection, 3);
  REQUIRE(top.size() == 64);
  REQUIRE(side.size() == 32);  // the upper half of a side
  CHECK(top[8 * 5 + 2] == formFactor(shareOf(projection, 0, 2, 5)));
  CHECK(side[8 * 1 + 2] == formFactor(shareOf(projection, 3, 2, 4 + 1)));
}

TEST_CASE("hemicube has the closed integrals over its pixels as delta form factors", "[hemicube]") {
  // The quadrature is exact to 1e-14, relative. The closed forms lose digits where corners cancel: four terms below
  // 1/4, each accurate to about 1e-16.
  for (const int resolution : {2, 8, 32, 128, 512}) {
    const Projection projection = hemicube(resolution);
    bool holds = true;
    double top = 0, side = 0;
    const auto agree = [](std::uint64_t share, double exact) {
      return std::abs(formFactor(share) - exact) <= 1e-14 * exact + 4e-16;
    };
    const auto edge = [resolution](int i) { return 2.0 * i / resolution - 1; };
    for (int j = 0; j < resolution; ++j)
      for (int i = 0; i < resolution; ++i) {
        const std::uint64_t share = shareOf(projection, 0, i, j);
        holds &= agree(share, pixel(toParallel, edge(i), edge(i + 1), edge(j), edge(j + 1)));
        top += formFactor(share);
      }
    for (std::size_t face = 1; face < 5; ++face)
      for (int j = resolution / 2; j < resolution; ++j)
        for (int i = 0; i < resolution; ++i) {
          const std::uint64_t share = shareOf(projection, face, i, j);
          holds &= agree(share, pixel(toPerpendicular, edge(j), edge(j + 1), edge(i), edge(i + 1)));
          side += formFactor(share);
        }
    INFO("resolution " << resolution);
    CHECK(holds);
    // Whole faces: four corners of toParallel(1, 1), two of toPerpendicular(1, 1) of each side.
    CHECK(top == Approx(4 * toParallel(1, 1)).epsilon(1e-13));
    CHECK(side == Approx(8 * toPerpendicular(1, 1)).epsilon(1e-13));
  }
  CHECK(4 * toParallel(1, 1) == Approx(0.554126423979572).epsilon(1e-14));
  CHECK(2 * toPerpendicular(1, 1) == Approx(0.111468394005107).epsilon(1e-14));
}

TEST_CASE("hemicubeFaces see each direction above the horizon with exactly one pixel", "[rows]") {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const auto direction = [&] { return glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random))); };
    const glm::dvec3 normal = direction();
    const glm::dvec3 up = repeat % 2 == 0 ? glm::dvec3(0) : direction();
    const auto faces = facesOver(hemicubeFaces(64), {1, 2, 3}, normal, up, 0.1);
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 d = direction();
      int seen = 0;
      for (const raster::Face& face : faces) {
        const double w = glm::dot(glm::dvec3(face.w), d);
        const double i = (glm::dot(glm::dvec3(face.x), d) / w + 1) * 32;
        const double j = (glm::dot(glm::dvec3(face.y), d) / w + 1) * 32;
        const raster::Scissor& s = face.scissor;
        seen += w > 0 && i >= s.column && i < s.column + s.width && j >= s.row && j < s.row + s.height;
      }
      // The rows are rounded to binary32, so that directions very close to the horizon are not tested.
      if (std::abs(glm::dot(d, normal)) > 1e-6) CHECK(seen == (glm::dot(d, normal) > 0 ? 1 : 0));
    }
    for (const raster::Face& face : faces) CHECK(raster::determinant(face) == Approx(1).epsilon(1e-6));
    if (repeat % 2 == 1) CHECK(glm::dot(glm::dvec3(faces[0].y), up) > 0);
  }
}
