// contactParts against what each of many points of a triangle has behind and before it.
#include "radiosity/geometry/contact_parts.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "raster/base/cross.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

constexpr double tolerance = 1e-6;

double areaOf(const std::vector<glm::dvec2>& corners) {
  double sum = 0;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += raster::cross(corners[i - 1] - corners[0], corners[i] - corners[0]) / 2;
  return sum;
}

bool contains(std::span<const glm::dvec2> corners, const glm::dvec2& point, double margin) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 edge = corners[(i + 1) % corners.size()] - corners[i];
    if (raster::cross(edge, point - corners[i]) < margin * glm::length(edge)) return false;
  }
  return true;
}

/// The parts of triangle `number` among all others, of which later ones cover. No shell is a skin.
std::vector<ContactPart> partsOf(const std::vector<TrianglePositions>& triangles, const Shells& shells,
                                 std::uint32_t number) {
  std::vector<NumberedTriangle> others;
  std::vector<std::int64_t> ranks;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (t != number) others.push_back({t, triangles[t]});
    ranks.push_back(t);
  }
  return contactParts(triangles[number], number, facesInPlace(triangles[number], others, tolerance),
                      {shells, std::vector<bool>(shells.kinds.size()), ranks});
}

}  // namespace

TEST_CASE("contactParts fill a triangle and agree with each of its points", "[contacts]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(0, 1);
  const auto place = [&] { return glm::dvec2(coordinate(random), coordinate(random)); };
  for (int scene = 0; scene < 200; ++scene) {
    // Triangles in one plane that look up or down; their numbers are their order in the file.
    std::vector<std::array<glm::dvec2, 3>> flat;
    std::vector<bool> looksUp;
    std::vector<TrianglePositions> triangles;
    while (flat.size() < 6) {
      std::array<glm::dvec2, 3> corners{place(), place(), place()};
      if (raster::cross(corners[1] - corners[0], corners[2] - corners[0]) < 0) std::swap(corners[1], corners[2]);
      if (areaOf({corners.begin(), corners.end()}) < 0.02) continue;
      flat.push_back(corners);
      looksUp.push_back(coordinate(random) < 0.5);
      auto turned = corners;
      if (!looksUp.back()) std::swap(turned[1], turned[2]);
      triangles.push_back({glm::dvec3(turned[0], 0), glm::dvec3(turned[1], 0), glm::dvec3(turned[2], 0)});
    }
    const Shells shells = findShells(triangles);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const std::vector<ContactPart> parts = partsOf(triangles, shells, t);
      double area = 0;
      for (const ContactPart& part : parts) area += areaOf(part.corners);
      if (!parts.empty()) CHECK(area == Approx(0.5).epsilon(1e-9));
      for (int i = 0; i < 50; ++i) {
        glm::dvec2 weights = place();
        if (weights.x + weights.y > 1) weights = 1.0 - weights;
        const glm::dvec3 position = triangles[t][0] + weights.x * (triangles[t][1] - triangles[t][0]) +
                                    weights.y * (triangles[t][2] - triangles[t][0]);
        const auto isAt = [&](std::uint32_t n, double margin) {
          return contains(flat[n], glm::dvec2(position), margin);
        };
        bool isBacked = false, isCovered = false, isNearEdge = false;
        for (std::uint32_t n = 0; n < triangles.size(); ++n) {
          isNearEdge = isNearEdge || isAt(n, -10 * tolerance) != isAt(n, 10 * tolerance);
          if (n == t || !isAt(n, 0)) continue;
          isBacked = isBacked || looksUp[n] != looksUp[t];
          isCovered = isCovered || (looksUp[n] == looksUp[t] && n > t);
        }
        if (isNearEdge) continue;
        const auto part = std::find_if(parts.begin(), parts.end(),
                                       [&](const ContactPart& some) { return contains(some.corners, weights, 0); });
        if (part == parts.end() && !parts.empty()) continue;  // between two parts
        const Contact contact = parts.empty() ? Contact{} : part->contact;
        CHECK(contact.isBacked == isBacked);
        CHECK(contact.coveredBy.has_value() == isCovered);
      }
    }
  }
}

TEST_CASE("contactParts ignore faces that are near, tilted or beside each other", "[contacts]") {
  const TrianglePositions one{glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}};
  const auto isAlone = [&](const TrianglePositions& other) {
    const std::vector<TrianglePositions> triangles{one, other};
    return partsOf(triangles, findShells(triangles), 0).empty();
  };
  CHECK_FALSE(isAlone({glm::dvec3(0, 0, 0), {0, 1, 0}, {1, 0, 0}}));
  CHECK_FALSE(isAlone({glm::dvec3(0, 0, 0.9e-6), {0, 1, 0.9e-6}, {1, 0, 0.9e-6}}));
  CHECK(isAlone({glm::dvec3(0, 0, 1.1e-6), {0, 1, 1.1e-6}, {1, 0, 1.1e-6}}));
  CHECK(isAlone({glm::dvec3(1, 0, 0), {1, 1, 0}, {0, 1, 0}}));
  CHECK(isAlone({glm::dvec3(0, 0, 0), {0, 1, 0}, {1, 0, 0.01}}));
  CHECK(isAlone({glm::dvec3(0, 0, 0), {0, 0, 1}, {1, 0, 0}}));
}

TEST_CASE("contactParts leave solids on sheets alone", "[contacts]") {
  // A tetrahedron stands on a larger triangle.
  const glm::dvec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, top{0.2, 0.2, 1};
  const std::vector<TrianglePositions> triangles{
      {a, c, b}, {a, b, top}, {b, c, top}, {c, a, top}, {glm::dvec3(-1, -1, 0), {4, -1, 0}, {-1, 4, 0}}};
  const Shells shells = findShells(triangles);
  REQUIRE(shells.kindOf(0) == ShellKind::Solid);
  for (const std::uint32_t t : {0U, 4U}) CHECK(partsOf(triangles, shells, t).empty());
}

TEST_CASE("facesInPlace say which share of a triangle lies in the place of another", "[contacts]") {
  const TrianglePositions one{glm::dvec3(0, 0, 0), {2, 0, 0}, {0, 2, 0}};
  const auto shareOf = [&](const TrianglePositions& other) {
    const std::vector<FaceInPlace> faces = facesInPlace(one, std::vector<NumberedTriangle>{{7, other}}, tolerance);
    return faces.empty() ? 0 : faces.front().share;
  };
  CHECK(shareOf(one) == Approx(1).epsilon(1e-12));
  CHECK(shareOf({glm::dvec3(0, 0, 0), {0, 2, 0}, {2, 0, 0}}) == Approx(1).epsilon(1e-12));
  CHECK(shareOf({glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}) == Approx(0.25).epsilon(1e-12));
  CHECK(shareOf({glm::dvec3(3, 0, 0), {4, 0, 0}, {3, 1, 0}}) == 0);
}
