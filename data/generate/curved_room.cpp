/// A closed room with a curved surface. The camera stands outside and looks through the front wall, whose back pictures
/// leave out.
#include <array>
#include <cmath>

#include "data/generate/models.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

constexpr int waveCells = 50;

/// The wave at (i, j) / 50 of its chart. Let b(t) = 4 t (1 - t), which is 0 at the ends of [0, 1] and 1 in the middle.
/// The height is 1.5 b(u)^2 b(v). The wave is then shifted sideways by 0.7 times its squared height, so that the crest
/// overhangs. Each height is shifted as a whole, so that the wave never meets itself. Coordinates are rounded to a
/// micrometre, which keeps the file short.
glm::dvec3 wavePoint(int i, int j) {
  const auto bump = [](double t) { return 4 * t * (1 - t); };
  const auto round = [](double x) { return std::nearbyint(x * 1e6) / 1e6; };
  const double u = static_cast<double>(i) / waveCells;
  const double v = static_cast<double>(j) / waveCells;
  const double height = 1.5 * (bump(u) * bump(u)) * bump(v);
  return {round(-2 + 3 * u + 0.7 * (height * height)), round(height), round(1.5 - 3 * v)};
}

/// Two triangles per cell. The chart is the grid itself: [0, 1]^2 without overlap.
std::vector<Polygon> wave() {
  std::vector<Polygon> triangles;
  const auto addTriangle = [&](const std::array<std::array<int, 2>, 3>& nodes) {
    Polygon triangle;
    for (const auto [i, j] : nodes) {
      triangle.corners.push_back(wavePoint(i, j));
      triangle.texcoords.emplace_back(static_cast<double>(i) / waveCells, static_cast<double>(j) / waveCells);
    }
    triangles.push_back(triangle);
  };
  for (int j = 0; j < waveCells; ++j) {
    for (int i = 0; i < waveCells; ++i) {
      addTriangle({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
      addTriangle({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  }
  return triangles;
}

/// The square in the floor under the wave, with a vertex at each vertex of the wave.
Polygon waveBorder() {
  Polygon border;
  for (int i = 0; i < waveCells; ++i) border.corners.push_back(wavePoint(i, 0));
  for (int i = 0; i < waveCells; ++i) border.corners.push_back(wavePoint(waveCells, i));
  for (int i = waveCells; i > 0; --i) border.corners.push_back(wavePoint(i, waveCells));
  for (int i = waveCells; i > 0; --i) border.corners.push_back(wavePoint(0, i));
  return border;
}

}  // namespace

Model curvedRoom() {
  Model model;
  model.name = "curved-room";
  model.about = {
      "A closed room whose floor rises to a wave: a curved surface of 5000 triangles with texture coordinates of its",
      "own, a grid of 50 x 50 cells over [0,1]^2. With b(t) = 4 t (1 - t) the wave is y = 1.5 b(u)^2 b(v) high and",
      "leans over: x = -2 + 3 u + 0.7 y^2, z = 1.5 - 3 v. It fills a hole in the floor. The light is cut out of the",
      "ceiling. Lengths, in metres, are made up. Written by hemitex_data.",
  };
  model.aboutMaterials = {
      "The materials of the room with a wave, made up: plain walls, two coloured ones and a warm light.",
      "Kd is diffuse reflectance, Ke emitted radiosity, both linear sRGB. Written by hemitex_data.",
  };
  model.materials = {{"plain", {0.72, 0.71, 0.68}},
                     {"orange", {0.74, 0.34, 0.08}},
                     {"teal", {0.08, 0.42, 0.44}},
                     {"foam", {0.7, 0.76, 0.78}},
                     {"light", glm::dvec3{0.5}, {20, 18, 15}}};

  const Polygon ceiling = rectangle(-2.5, 2.5, -2.5, 2.5, 3.2);
  const Polygon light = rectangle(-0.5, 0.5, -0.5, 0.5, 3.2);
  model.groups = walls(ceiling, {"plain", "teal", "plain", "orange"});
  model.groups.push_back({"floor", "plain", frame(atHeight(ceiling, 0), waveBorder())});
  model.groups.push_back({"ceiling", "plain", frame(reversed(ceiling), reversed(light))});
  model.groups.push_back({"wave", "foam", wave()});
  model.groups.push_back({"light", "light", {reversed(light)}});
  model.view = {{0, 1.6, 7}, {0, 1.6, 0}, {0, 1, 0}, 39};
  return model;
}

}  // namespace hemitex::data
