// The cubic tetrahedron: delta form factors compared with Lambert's contour integral, and faces that partition the half
// space.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "radiosity/projection/projection_kinds.h"
#include "reference/truth/closed_forms/point_to_polygon.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Polygons on a face at distance 1, by their corners in pixels of the viewport (column and row, from its first).
class Face {
 public:
  Face(const ProjectionFace& face, int resolution) : face_(face), resolution_(resolution) {}

  /// From the origin with the projection's normal; the part below the horizon is cut off.
  double formFactorTo(std::vector<glm::dvec2> pixels) const {
    std::vector<glm::dvec3> polygon;
    for (const glm::dvec2& p : pixels) polygon.push_back(at(p));
    if (glm::dot(glm::cross(polygon[1] - polygon[0], polygon[2] - polygon[1]), polygon[0]) > 0)
      std::reverse(polygon.begin(), polygon.end());
    return reference::pointToPolygon(glm::dvec3(0), glm::dvec3(0, 0, 1), polygon);
  }

 private:
  /// The point at w = 1 of a place in the viewport.
  glm::dvec3 at(const glm::dvec2& p) const {
    const glm::dmat3 rows = glm::transpose(glm::dmat3(face_.x, face_.y, face_.w));
    return glm::inverse(rows) * glm::dvec3(2 * p.x / resolution_ - 1, 2 * p.y / resolution_ - 1, 1);
  }

  const ProjectionFace& face_;
  int resolution_;
};

}  // namespace

TEST_CASE("cubicTetrahedron has delta form factors that sum to exactly one", "[tetrahedron]") {
  for (const int resolution : {2, 4, 6, 10, 30, 32, 64, 100, 128, 254, 256, 512}) {
    const Projection tetrahedron = cubicTetrahedron(resolution);
    std::uint64_t total = 0;
    for (const ProjectionFace& face : tetrahedron.faces) total += tetrahedron.sharesBefore[face.shares].back();
    INFO("resolution " << resolution);
    CHECK(total == wholeShare);
    CHECK(tetrahedron.captured == wholeShare);
  }
}

TEST_CASE("cubicTetrahedron has equal delta form factors on all faces and across their diagonals", "[tetrahedron]") {
  const Projection tetrahedron = cubicTetrahedron(64);
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i) {
      const std::uint64_t share = shareOf(tetrahedron, 1, i, j);
      REQUIRE(share == shareOf(tetrahedron, 1, j, i));
      REQUIRE(share == shareOf(tetrahedron, 2, i, j));
      REQUIRE(share + (i == 63 && j == 63 ? 1 : 0) == shareOf(tetrahedron, 0, i, j));
      REQUIRE((share > 0) == (i + j >= 63));
    }
}

TEST_CASE("cubicTetrahedron has the integrals over the areas of its pixels as delta form factors", "[tetrahedron]") {
  // The reference is accurate to 1e-9. A pixel along the horizon has the part of its square above it, and half of the
  // corners above the horizon beside it. These corners are triangles with sides of half a pixel along the grid.
  for (const int resolution : {2, 6, 16, 64}) {
    const Projection tetrahedron = cubicTetrahedron(resolution);
    for (std::size_t f = 0; f < 3; ++f) {
      const Face face(tetrahedron.faces[f], resolution);
      bool holds = true;
      for (int j = 0; j < resolution; ++j)
        for (int i = resolution - 1 - j; i < resolution; ++i) {
          double exact = face.formFactorTo({{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
          if (i + j == resolution - 1) {
            const auto corner = [&](const glm::dvec2& tip, bool toRight) {
              const glm::dvec2 left = tip - glm::dvec2(0.5, 0), under = tip - glm::dvec2(0, 0.5);
              const bool isLast = tip.x == 0 || tip.y == 0;
              const glm::dvec2 middle = (left + under) / 2.0;
              if (isLast) return face.formFactorTo({tip, left, under});
              return toRight ? face.formFactorTo({tip, middle, under}) : face.formFactorTo({tip, left, middle});
            };
            exact += corner({i, j + 1}, true) + corner({i + 1, j}, false);
          }
          holds &= formFactor(shareOf(tetrahedron, f, i, j)) == Approx(exact).epsilon(2e-9);
        }
      INFO("R = " << resolution << ", face " << f);
      CHECK(holds);
    }
  }
}

TEST_CASE("cubicTetrahedron sees each direction above the horizon with exactly one face", "[tetrahedron]") {
  // Except three tips half a pixel wide along the horizon, which no pixel covers.
  constexpr int resolution = 64;
  const std::vector<ProjectionFace> faces = cubicTetrahedronFaces(resolution);
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  for (int repeat = 0; repeat < 5000; ++repeat) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(gauss(random), gauss(random), std::abs(gauss(random)) + 0.03));
    int seen = 0;
    for (const raster::Face& face : facesOver(faces, {1, 2, 3}, {0, 0, 1}, {0, 1, 0}, 0.1)) {
      const glm::dvec3 local(glm::dot(glm::dvec3(face.x), d), glm::dot(glm::dvec3(face.y), d),
                             glm::dot(glm::dvec3(face.w), d));
      seen += local.z > 0 && std::abs(local.x) <= local.z && std::abs(local.y) <= local.z;
    }
    REQUIRE(seen == 1);
  }
}

TEST_CASE("cubicTetrahedron has no sample near the horizon, and those above it are within its reach", "[tetrahedron]") {
  // The samples on both sides of the horizon are at least a quarter of a pixel's diagonal away from it.
  for (const int resolution : {2, 64, 4096}) {
    const std::vector<ProjectionFace> faces = cubicTetrahedronFaces(resolution);
    const Projection tetrahedron{faces, {}, wholeShare, 6};
    for (const ProjectionFace& face : faces) {
      const glm::dmat3 inverse = glm::inverse(glm::transpose(glm::dmat3(face.x, face.y, face.w)));
      const auto sample = [&](int i, int j) {
        return inverse * glm::dvec3((2.0 * i + 1) / resolution - 1, (2.0 * j + 1) / resolution - 1, 1);
      };
      const double pixel = 6.0 / (2 * resolution + 1);
      for (int i = 0; i < resolution; ++i) {
        const glm::dvec3 above = sample(i, resolution - 1 - i);
        REQUIRE(above.z * std::sqrt(3.0) == Approx(pixel / 2).epsilon(1e-9));
        REQUIRE(glm::dot(above, above) < 6);
        if (i > 0) REQUIRE(sample(i - 1, resolution - 1 - i).z * std::sqrt(3.0) == Approx(-pixel / 2).epsilon(1e-9));
      }
    }
  }
}
