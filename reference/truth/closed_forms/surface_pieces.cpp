#include "reference/truth/closed_forms/surface_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/grid_clipping.h"

namespace hemitex::reference {
namespace {

using radiosity::Grid;
using radiosity::Piece;
using radiosity::Triangle;

std::vector<glm::dvec3> cornersOf(const std::array<glm::dvec3, 3>& triangle, const Piece& piece) {
  std::vector<glm::dvec3> corners;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const glm::dvec2& weight = piece.corners[i].weight;
    corners.push_back(triangle[0] + weight.x * (triangle[1] - triangle[0]) + weight.y * (triangle[2] - triangle[0]));
  }
  return corners;
}

std::vector<glm::dvec2> onChart(const Piece& piece) {
  std::vector<glm::dvec2> places;
  for (std::size_t i = 0; i < piece.size; ++i) places.push_back(piece.corners[i].grid);
  return places;
}

/// `first` is the number of the surface's first triangle in the scene.
void appendPieces(const radiosity::Scene& scene, std::uint32_t number, std::uint32_t first, const Grid& grid,
                  std::vector<SurfacePiece>& pieces) {
  const radiosity::Surface& surface = scene.surfaces[number];
  const auto columns = static_cast<std::uint32_t>(grid.columns);
  const auto append = [&](std::size_t texel, std::uint32_t t, const Piece& piece) {
    if (radiosity::share(piece) == 0) return;
    const Triangle& triangle = surface.triangles[t];
    const auto place = static_cast<std::uint32_t>(texel);
    pieces.push_back({grid.elementOfTexel[texel],
                      first + t,
                      radiosity::normal(triangle),
                      cornersOf(inFrame(scene, triangle), piece),
                      onChart(piece),
                      number,
                      {place % columns, place / columns}});
  };
  radiosity::forEachExposedPiece(surface, radiosity::texelGrid(grid), append);
}

}  // namespace

glm::dvec3 inFrame(const radiosity::Scene& scene, const glm::dvec3& position) {
  return (position - scene.origin) / scene.extent;
}

std::array<glm::dvec3, 3> inFrame(const radiosity::Scene& scene, const radiosity::Triangle& triangle) {
  const auto& [a, b, c] = triangle.position;
  return {inFrame(scene, a), inFrame(scene, b), inFrame(scene, c)};
}

std::vector<SceneTriangle> sceneTriangles(const radiosity::Scene& scene) {
  std::vector<SceneTriangle> triangles;
  radiosity::forEachPlace(scene, [&](const radiosity::TrianglePlace& place) {
    const radiosity::Surface& surface = scene.surfaces[place.surface];
    const radiosity::Triangle& triangle = surface.triangles[place.triangle];
    triangles.push_back({place, &triangle, &scene.instances[place.instance], triangle.isBacked,
                         radiosity::holedTriangle(scene, place)});
  });
  return triangles;
}

SurfacePieces surfacePieces(const radiosity::Scene& scene, const radiosity::Discretization& discretization) {
  SurfacePieces result;
  std::uint32_t first = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    appendPieces(scene, s, first, discretization.grids[s], result.pieces);
    first += static_cast<std::uint32_t>(scene.surfaces[s].triangles.size());
  }
  std::stable_sort(result.pieces.begin(), result.pieces.end(),
                   [](const SurfacePiece& a, const SurfacePiece& b) { return a.element < b.element; });
  result.first.assign(discretization.elements.size() + 1, 0);
  for (const SurfacePiece& piece : result.pieces) ++result.first[piece.element + 1];
  for (std::size_t e = 1; e < result.first.size(); ++e) result.first[e] += result.first[e - 1];
  return result;
}

SurfacePieces withImages(const SurfacePieces& pieces, const radiosity::Scene& scene) {
  if (scene.instances.size() == 1) return pieces;
  const auto triangles = static_cast<std::uint32_t>(radiosity::triangleCount(scene));
  SurfacePieces result;
  for (std::uint32_t element = 0; element + 1 < pieces.first.size(); ++element) {
    result.first.push_back(static_cast<std::uint32_t>(result.pieces.size()));
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
      for (SurfacePiece piece : pieces.of(element)) {
        const radiosity::Instance& instance = scene.instances[i];
        const glm::dvec3 shift = inFrame(scene, instance(scene.origin));
        for (glm::dvec3& corner : piece.corner) corner = instance.sign * corner + shift;
        piece.normal *= instance.sign;
        piece.triangle += i * triangles;
        if (instance.reflects()) {
          std::reverse(piece.corner.begin(), piece.corner.end());
          std::reverse(piece.onChart.begin(), piece.onChart.end());
        }
        result.pieces.push_back(std::move(piece));
      }
  }
  result.first.push_back(static_cast<std::uint32_t>(result.pieces.size()));
  return result;
}

std::uint32_t elementAt(const SceneTriangle& triangle, const radiosity::Discretization& discretization,
                        const glm::dvec2& weights) {
  return elementAt(*triangle.triangle, discretization.grids[triangle.place.surface],
                   radiosity::placedWeights(weights, *triangle.instance));
}

std::uint32_t elementAt(const Triangle& triangle, const Grid& grid, const glm::dvec2& weights) {
  const std::array<glm::dvec2, 3> texels = radiosity::inTexels(triangle, grid.columns, grid.rows);
  const glm::dvec2 place = texels[0] + weights.x * (texels[1] - texels[0]) + weights.y * (texels[2] - texels[0]);
  const auto column = static_cast<std::int64_t>(std::floor(place.x)),
             row = static_cast<std::int64_t>(std::floor(place.y));
  return grid.elementOfTexel[radiosity::texelOfCell(column, row, grid.columns, grid.rows)];
}

}  // namespace hemitex::reference
