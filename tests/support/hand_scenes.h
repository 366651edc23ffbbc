/// Surfaces built from shapes and charts, and scenes of them.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <random>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "tests/support/box_scene.h"

namespace hemitex::tests {

/// A corner of a surface: its position and its place on the chart.
struct Corner {
  glm::dvec3 position;
  glm::dvec2 chart;
};

/// Rounds a chart coordinate to binary32.
inline glm::dvec2 rounded(const glm::dvec2& chart) { return glm::dvec2(glm::vec2(chart)); }

/// A triangle whose texture coordinates are its chart.
inline radiosity::Triangle triangleOf(const Corner& a, const Corner& b, const Corner& c) {
  const std::array<glm::dvec2, 3> chart{rounded(a.chart), rounded(b.chart), rounded(c.chart)};
  return {{a.position, b.position, c.position}, chart, chart};
}

inline radiosity::Surface surfaceOf(const std::string& name, std::vector<radiosity::Triangle> triangles) {
  return {.name = name, .family = name, .triangles = std::move(triangles)};
}

/// A parallelogram from a corner along two edges.
inline radiosity::Surface parallelogram(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u,
                                        const glm::dvec3& v) {
  return quad(name, {corner, corner + u, corner + u + v, corner + v});
}

/// A flat surface in the plane z = 0 of triangles given on the chart; one unit of length is one unit of the chart.
inline radiosity::Surface flat(const std::string& name, const std::vector<std::array<glm::dvec2, 3>>& triangles) {
  std::vector<radiosity::Triangle> result;
  const auto corner = [](const glm::dvec2& chart) { return Corner{{rounded(chart), 0}, chart}; };
  for (const std::array<glm::dvec2, 3>& t : triangles)
    result.push_back(triangleOf(corner(t[0]), corner(t[1]), corner(t[2])));
  return surfaceOf(name, std::move(result));
}

/// The axis-parallel rectangle of the chart from `low` to `high`.
inline std::vector<std::array<glm::dvec2, 3>> rectangle(const glm::dvec2& low, const glm::dvec2& high) {
  const glm::dvec2 right(high.x, low.y), left(low.x, high.y);
  return {{low, right, high}, {low, high, left}};
}

inline std::vector<std::array<glm::dvec2, 3>> joined(std::vector<std::array<glm::dvec2, 3>> a,
                                                     const std::vector<std::array<glm::dvec2, 3>>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// An L: the unit square without the quarter at its upper right.
inline radiosity::Surface lShape() {
  return flat("l", joined(rectangle({0, 0}, {1, 0.5}), rectangle({0, 0.5}, {0.5, 1})));
}

/// A ring between the circles of radius 0.2 and 0.5, of 2 * steps triangles.
inline radiosity::Surface ring(int steps) {
  std::vector<std::array<glm::dvec2, 3>> triangles;
  const auto at = [&](int step, double radius) {
    const double angle = 2 * 3.14159265358979323846 * (step % steps) / steps;
    return glm::dvec2(0.5) + radius * glm::dvec2(std::cos(angle), std::sin(angle));
  };
  for (int i = 0; i < steps; ++i) {
    triangles.push_back({at(i, 0.2), at(i, 0.5), at(i + 1, 0.5)});
    triangles.push_back({at(i, 0.2), at(i + 1, 0.5), at(i + 1, 0.2)});
  }
  return flat("ring", triangles);
}

/// A strip of the given width from corner to corner of the chart.
inline radiosity::Surface thinDiagonal(double width) {
  return flat("diagonal", {{glm::dvec2(0, 0), glm::dvec2(width, 0), glm::dvec2(1, 1 - width)},
                           {glm::dvec2(0, 0), glm::dvec2(1, 1 - width), glm::dvec2(1, 1)}});
}

/// A bump over the unit square, of 2 * steps^2 triangles; 50 steps make the 5000 of the paper's Figure 3 (c).
inline radiosity::Surface bump(int steps) {
  std::vector<radiosity::Triangle> triangles;
  const auto at = [&](int i, int j) {
    const double u = double(i) / steps, v = double(j) / steps;
    return Corner{{3 * u, 2 * v, 8 * u * (1 - u) * v * (1 - v)}, {u, v}};
  };
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i) {
      triangles.push_back(triangleOf(at(i, j), at(i + 1, j), at(i + 1, j + 1)));
      triangles.push_back(triangleOf(at(i, j), at(i + 1, j + 1), at(i, j + 1)));
    }
  return surfaceOf("bump", std::move(triangles));
}

/// Triangles from the chart's middle to points scattered around it: a star of slivers and wedges.
inline radiosity::Surface star(int spikes, unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&] { return double(random()) / 4294967296.0; };
  std::vector<std::array<glm::dvec2, 3>> triangles;
  const double turn = 2 * 3.14159265358979323846 / spikes;
  for (int i = 0; i < spikes; ++i) {
    const double from = turn * i, to = turn * (i + draw()), reach = 0.5 * draw();
    const auto at = [&](double angle, double radius) {
      return glm::dvec2(0.5) + radius * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    triangles.push_back({glm::dvec2(0.5), at(from, reach), at(to, 0.5 * draw())});
  }
  std::erase_if(triangles, [](const std::array<glm::dvec2, 3>& t) {
    const glm::dvec2 a = rounded(t[1]) - rounded(t[0]), b = rounded(t[2]) - rounded(t[0]);
    return a.x * b.y - a.y * b.x <= 0;
  });
  return flat("star", triangles);
}

/// A scene of surfaces with one grey material.
inline radiosity::Scene sceneOf(std::vector<radiosity::Surface> surfaces) {
  radiosity::Scene scene;
  scene.materials.resize(1);
  scene.surfaces = std::move(surfaces);
  return finish(std::move(scene));
}

/// The six faces of the box [low, low + size], seen from inside or from outside.
inline std::vector<radiosity::Surface> box(const std::string& name, const glm::dvec3& low, const glm::dvec3& size,
                                           bool inwards) {
  const glm::dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  const auto face = [&](int number, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    return parallelogram(name + std::to_string(number), low + corner, inwards ? u : v, inwards ? v : u);
  };
  return {face(0, {}, x, y), face(1, z, y, x),  face(2, {}, y, z),
          face(3, x, z, y),  face(4, {}, z, x), face(5, y, x, z)};
}

inline double totalArea(const radiosity::Surface& surface) {
  long double sum = 0;
  for (const radiosity::Triangle& triangle : surface.triangles) sum += radiosity::area(triangle);
  return static_cast<double>(sum);
}

/// Surfaces for property tests: flat and curved ones, slivers and holes, charts that end inside texels. They lie above
/// each other without contact, so that all of each is exposed.
inline std::vector<radiosity::Surface> tableOfSurfaces() {
  std::vector<radiosity::Surface> surfaces{parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                           quad("warped", {{{0, 0, 0}, {2, 0, 1}, {2, 3, -1}, {0, 1, 2}}}),
                                           flat("triangle", {{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0.3, 1)}}),
                                           flat("corner", rectangle({0.37, 0.41}, {0.43, 0.52})),
                                           lShape(),
                                           ring(40),
                                           thinDiagonal(0.01),
                                           thinDiagonal(1e-6),
                                           bump(50),
                                           star(60, 1),
                                           star(500, 2)};
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (radiosity::Triangle& triangle : surfaces[s].triangles)
      for (glm::dvec3& corner : triangle.position) corner.z += 8.0 * static_cast<double>(s);
  return surfaces;
}

/// A closed room with a box on its floor (without a face on the floor) and a sheet that hangs in it.
inline radiosity::Scene furnishedRoom() {
  std::vector<radiosity::Surface> surfaces = box("room", {0, 0, 0}, {4, 3, 2}, true);
  const std::vector<radiosity::Surface> onFloor = box("box", {1, 1, 0}, {1, 1, 1}, false);
  surfaces.insert(surfaces.end(), onFloor.begin() + 1, onFloor.end());
  surfaces.push_back(parallelogram("sheet", {2.5, 0.5, 1.5}, {1, 0, 0}, {0, 1, 0.2}));
  return sceneOf(std::move(surfaces));
}

}  // namespace hemitex::tests
