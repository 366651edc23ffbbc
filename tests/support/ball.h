/// A ball of triangles whose corners lie on the unit sphere.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace hemitex::tests {

/// An icosahedron with each triangle divided into four, `levels` times: 20 * 4^levels triangles that face outwards.
inline std::vector<std::array<glm::dvec3, 3>> icosphere(int levels) {
  const double t = (1 + std::sqrt(5.0)) / 2;
  const std::array<glm::dvec3, 12> corners{{{-1, t, 0},
                                            {1, t, 0},
                                            {-1, -t, 0},
                                            {1, -t, 0},
                                            {0, -1, t},
                                            {0, 1, t},
                                            {0, -1, -t},
                                            {0, 1, -t},
                                            {t, 0, -1},
                                            {t, 0, 1},
                                            {-t, 0, -1},
                                            {-t, 0, 1}}};
  constexpr std::array<std::array<std::size_t, 3>, 20> faces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  std::vector<std::array<glm::dvec3, 3>> triangles;
  for (const auto& [a, b, c] : faces)
    triangles.push_back({glm::normalize(corners[a]), glm::normalize(corners[b]), glm::normalize(corners[c])});
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<glm::dvec3, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return triangles;
}

/// The triangles as text of an OBJ file, without shared vertices.
inline std::string objText(const std::vector<std::array<glm::dvec3, 3>>& triangles) {
  std::string text;
  char line[128];
  for (const auto& triangle : triangles) {
    for (const glm::dvec3& p : triangle) {
      std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
      text += line;
    }
    text += "f -3 -2 -1\n";
  }
  return text;
}

}  // namespace hemitex::tests
