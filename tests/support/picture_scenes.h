/// Scenes and discretizations built directly, for tests of later stages.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "tests/support/hand_scenes.h"

namespace hemitex::tests {

inline radiosity::Scene sceneOf(std::vector<radiosity::Surface> surfaces, std::vector<radiosity::Material> materials) {
  radiosity::Scene scene;
  scene.materials = std::move(materials);
  scene.surfaces = std::move(surfaces);
  return finish(std::move(scene));
}

/// The six walls of [-1,1]^3, facing inwards, one polygon each, v upwards for upright walls.
inline radiosity::Scene makeRoom() {
  std::vector<radiosity::Surface> walls{parallelogram("left", {-1, -1, 1}, {0, 0, -2}, {0, 2, 0}),
                                        parallelogram("right", {1, -1, -1}, {0, 0, 2}, {0, 2, 0}),
                                        parallelogram("floor", {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}),
                                        parallelogram("ceiling", {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}),
                                        parallelogram("back", {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}),
                                        parallelogram("front", {1, -1, 1}, {-2, 0, 0}, {0, 2, 0})};
  for (std::uint32_t wall = 0; wall < walls.size(); ++wall)
    for (radiosity::Triangle& triangle : walls[wall].triangles) triangle.polygon = wall;
  return sceneOf(std::move(walls));
}

/// Adds a grid to a discretization: an element of area 1 for each texel that `covered` marks, and one patch for all.
/// Other texels map to the first element.
inline void addGrid(radiosity::Discretization& discretization, int columns, int rows, std::vector<bool> covered = {}) {
  if (covered.empty()) covered.assign(static_cast<std::size_t>(columns * rows), true);
  radiosity::Grid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.firstElement = static_cast<std::uint32_t>(discretization.elements.size());
  grid.covered = covered;
  for (std::uint32_t texel = 0; texel < covered.size(); ++texel) {
    grid.elementOfTexel.push_back(covered[texel] ? static_cast<std::uint32_t>(discretization.elements.size())
                                                 : grid.firstElement);
    if (!covered[texel]) {
      ++grid.phantoms;
      continue;
    }
    const auto surface = static_cast<std::uint32_t>(discretization.grids.size());
    discretization.elements.push_back({.area = 1, .surface = surface, .texel = texel});
    ++grid.elementCount;
  }
  discretization.grids.push_back(grid);
}

/// A scene of unit quads with grids of texels.
struct ChartScene {
  radiosity::Scene scene;
  radiosity::Discretization discretization;
};

inline ChartScene makeCharts(const std::vector<glm::ivec2>& grids) {
  ChartScene charts;
  std::vector<radiosity::Surface> surfaces;
  for (const glm::ivec2& grid : grids) {
    surfaces.push_back(parallelogram("chart", {static_cast<double>(surfaces.size()), 0, 0}, {1, 0, 0}, {0, 1, 0}));
    addGrid(charts.discretization, grid.x, grid.y);
  }
  charts.scene = sceneOf(surfaces);
  return charts;
}

}  // namespace hemitex::tests
