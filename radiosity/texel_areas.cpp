#include "radiosity/texel_areas.h"

#include <algorithm>
#include <cmath>

#include "radiosity/cell_clipping.h"

namespace hemitex::radiosity {
namespace {

double chartArea(const std::array<glm::dvec2, 3>& grid) {
  const glm::dvec2 a = grid[1] - grid[0], b = grid[2] - grid[0];
  return std::abs(a.x * b.y - a.y * b.x) / 2;
}

/// What was found so far of the triangle that stands for each texel.
struct TexelTriangles {
  std::vector<bool> hasMiddle;
  std::vector<double> largestPiece;
};

}  // namespace

std::array<glm::dvec2, 3> inTexels(const Triangle& triangle, int columns, int rows) {
  const glm::dvec2 size(columns, rows);
  return {triangle.chart[0] * size, triangle.chart[1] * size, triangle.chart[2] * size};
}

std::size_t texelOfCell(std::int64_t column, std::int64_t row, int columns, int rows) {
  const auto i = static_cast<std::size_t>(std::clamp<std::int64_t>(column, 0, columns - 1));
  const auto j = static_cast<std::size_t>(std::clamp<std::int64_t>(row, 0, rows - 1));
  return j * static_cast<std::size_t>(columns) + i;
}

TexelAreas texelAreas(const Surface& surface, int columns, int rows) {
  const std::size_t count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  TexelAreas texels{std::vector<double>(count), std::vector<double>(count), std::vector<std::uint32_t>(count)};
  TexelTriangles found{std::vector<bool>(count), std::vector<double>(count)};
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const std::array<glm::dvec2, 3> grid = inTexels(surface.triangles[t], columns, rows);
    const double surfaceArea = area(surface.triangles[t]);
    const double gridArea = chartArea(grid);
    forEachCell(grid, [&](std::int64_t column, std::int64_t row, const Piece& piece) {
      const std::size_t texel = texelOfCell(column, row, columns, rows);
      const double part = share(piece);
      texels.area[texel] += part * surfaceArea;
      texels.coverage[texel] += part * gridArea;
      if (found.hasMiddle[texel]) return;
      const glm::dvec2 middle(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      found.hasMiddle[texel] = weightsAt(grid, middle).has_value();
      if (found.hasMiddle[texel] || part * surfaceArea > found.largestPiece[texel]) {
        found.largestPiece[texel] = part * surfaceArea;
        texels.triangle[texel] = t;
      }
    });
  }
  return texels;
}

}  // namespace hemitex::radiosity
