#include "radiosity/discretization/texel_areas.h"

#include <cmath>

#include "radiosity/geometry/grid_clipping.h"

namespace hemitex::radiosity {
namespace {

double chartArea(const std::array<glm::dvec2, 3>& grid) {
  const glm::dvec2 a = grid[1] - grid[0], b = grid[2] - grid[0];
  return std::abs(a.x * b.y - a.y * b.x) / 2;
}

struct MeasuredTriangle {
  std::array<glm::dvec2, 3> corners;  ///< in texels
  double area, chartArea;             ///< on the surface, and in texels
};

/// The candidates so far for the representative triangle of each texel.
struct TexelTriangles {
  std::vector<bool> hasMiddle;
  std::vector<double> largestPiece;
};

}  // namespace

TexelAreas texelAreas(const Surface& surface, const TexelGrid& grid) {
  const std::size_t count = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  TexelAreas texels{std::vector<double>(count), std::vector<double>(count), std::vector<std::uint32_t>(count)};
  TexelTriangles found{std::vector<bool>(count), std::vector<double>(count)};
  std::vector<MeasuredTriangle> triangles;
  for (const Triangle& triangle : surface.triangles) {
    const std::array<glm::dvec2, 3> corners = inTexels(triangle, grid.columns, grid.rows);
    triangles.push_back({corners, area(triangle), chartArea(corners)});
  }
  const auto columns = static_cast<std::size_t>(grid.columns);
  forEachExposedPiece(surface, grid, [&](std::size_t texel, std::uint32_t t, const Piece& piece) {
    const double part = share(piece);
    texels.area[texel] += part * triangles[t].area;
    texels.coverage[texel] += part * triangles[t].chartArea;
    if (found.hasMiddle[texel]) return;
    const glm::dvec2 middle = glm::dvec2(texel % columns, texel / columns) + 0.5;
    found.hasMiddle[texel] = weightsAt(triangles[t].corners, middle).has_value();
    if (found.hasMiddle[texel] || part * triangles[t].area > found.largestPiece[texel]) {
      found.largestPiece[texel] = part * triangles[t].area;
      texels.triangle[texel] = t;
    }
  });
  return texels;
}

}  // namespace hemitex::radiosity
