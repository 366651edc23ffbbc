#include "reference/truth/closed_forms/scene_form_factors.h"

#include "radiosity/geometry/triangulation.h"
#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/polygon_to_polygon.h"

namespace hemitex::reference {
namespace {

/// In squared extents of the scene: removes rounding noise along cuts, as long as a texel and 1e-17 wide.
constexpr double minArea = 1e-17;

/// Of the form factor between two pieces, if it is more than the relative error of polygonToPolygon.
constexpr double maxError = 1e-14;

double areaOf(const SurfacePiece& piece) { return glm::dot(radiosity::newellNormal(piece.corner), piece.normal) / 2; }

struct ShootingPiece {
  const SurfacePiece* piece;
  double area;
};

double formFactor(const ShootingPiece& from, std::span<const SurfacePiece> element) {
  double sum = 0;
  for (const SurfacePiece& to : element)
    if (to.triangle != from.piece->triangle && areaOf(to) > minArea)
      sum += polygonToPolygon(from.piece->corner, to.corner, {.absolute = maxError});
  return sum;
}

}  // namespace

std::vector<double> analyticRow(const SurfacePieces& from, std::span<const std::uint32_t> elements,
                                const SurfacePieces& to) {
  std::vector<ShootingPiece> shooting;
  double area = 0;
  for (const std::uint32_t element : elements)
    for (const SurfacePiece& piece : from.of(element)) {
      shooting.push_back({&piece, areaOf(piece)});
      area += shooting.back().area;
    }
  std::vector<double> row(to.first.size() - 1, 0.0);
  raster::parallelFor(row.size(), [&](std::size_t element) {
    for (const ShootingPiece& piece : shooting)
      if (piece.area > minArea)
        row[element] += piece.area / area * formFactor(piece, to.of(static_cast<std::uint32_t>(element)));
  });
  return row;
}

}  // namespace hemitex::reference
