#include "radiosity/textures/gouraud_texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/grid_clipping.h"

namespace hemitex::radiosity {
namespace {

/// A polygon of the chart that belongs to an element; corners in texels.
struct Polygon {
  std::size_t texel = 0;
  std::uint32_t element = 0;
  std::vector<glm::dvec2> corners;
};

std::vector<Polygon> polygonsOf(const Surface& surface, const Grid& grid) {
  std::vector<Polygon> polygons;
  for (const Triangle& triangle : surface.triangles)
    forEachCell(inTexels(triangle, grid.columns, grid.rows),
                [&](std::int64_t column, std::int64_t row, const Piece& piece) {
                  if (share(piece) == 0) return;
                  const std::size_t texel = texelOfCell(column, row, grid.columns, grid.rows);
                  Polygon polygon{texel, grid.elementOfTexel[texel], {}};
                  for (std::size_t i = 0; i < piece.size; ++i) polygon.corners.push_back(piece.corners[i].grid);
                  polygons.push_back(std::move(polygon));
                });
  return polygons;
}

/// Corners that are equal up to rounding, in units of 2^-16 texels.
using CornerKey = std::pair<std::int64_t, std::int64_t>;

CornerKey keyOf(const glm::dvec2& corner) { return {std::llround(corner.x * 0x1p16), std::llround(corner.y * 0x1p16)}; }

/// The mean over the elements adjacent to each corner, each element once.
std::map<CornerKey, glm::dvec3> cornerValues(const std::vector<Polygon>& polygons,
                                             const std::vector<glm::dvec3>& radiosity) {
  std::map<CornerKey, std::vector<std::uint32_t>> elements;
  for (const Polygon& polygon : polygons)
    for (const glm::dvec2& corner : polygon.corners) elements[keyOf(corner)].push_back(polygon.element);
  std::map<CornerKey, glm::dvec3> values;
  for (auto& [key, around] : elements) {
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    glm::dvec3 sum(0);
    for (const std::uint32_t element : around) sum += radiosity[element];
    values[key] = sum / static_cast<double>(around.size());
  }
  return values;
}

/// The radiosity at a point of a polygon; nothing outside.
std::optional<glm::dvec3> shaded(const Polygon& polygon, const std::vector<glm::dvec3>& values,
                                 const glm::dvec2& point) {
  for (std::size_t i = 2; i < polygon.corners.size(); ++i)
    if (const auto weights = weightsAt({polygon.corners[0], polygon.corners[i - 1], polygon.corners[i]}, point))
      return values[0] + weights->x * (values[i - 1] - values[0]) + weights->y * (values[i] - values[0]);
  return std::nullopt;
}

glm::dvec3 meanOf(const std::vector<glm::dvec3>& values) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

std::vector<glm::dvec3> gouraudTexels(const Surface& surface, const Grid& grid,
                                      const std::vector<glm::dvec3>& radiosity, int magnification) {
  const std::vector<Polygon> polygons = polygonsOf(surface, grid);
  const std::map<CornerKey, glm::dvec3> valueAt = cornerValues(polygons, radiosity);
  const auto columns = static_cast<std::size_t>(grid.columns), times = static_cast<std::size_t>(magnification);
  std::vector<std::optional<glm::dvec3>> drawn(grid.elementOfTexel.size() * times * times);
  std::vector<glm::dvec3> elsewhere;  // by texel of the grid
  for (const std::uint32_t element : grid.elementOfTexel) elsewhere.push_back(radiosity[element]);
  for (const Polygon& polygon : polygons) {
    std::vector<glm::dvec3> values;
    for (const glm::dvec2& corner : polygon.corners) values.push_back(valueAt.at(keyOf(corner)));
    elsewhere[polygon.texel] = meanOf(values);
    const std::size_t column = polygon.texel % columns * times, row = polygon.texel / columns * times;
    for (std::size_t j = row; j < row + times; ++j)
      for (std::size_t i = column; i < column + times; ++i) {
        std::optional<glm::dvec3>& texel = drawn[j * columns * times + i];
        if (!texel) texel = shaded(polygon, values, (glm::dvec2(i, j) + 0.5) / static_cast<double>(magnification));
      }
  }
  std::vector<glm::dvec3> texels;
  for (std::size_t texel = 0; texel < drawn.size(); ++texel) {
    const std::size_t column = texel % (columns * times), row = texel / (columns * times);
    texels.push_back(drawn[texel].value_or(elsewhere[row / times * columns + column / times]));
  }
  return texels;
}

}  // namespace hemitex::radiosity
