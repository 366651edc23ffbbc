#include "reference/rays/ray_source.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "radiosity/discretization/patch_points.h"
#include "reference/closed_forms/surface_pieces.h"
#include "reference/rays/ray_caster.h"

namespace hemitex::reference {
namespace {

constexpr double moveIntoTriangle = 0x1p-30;

double doubledArea(const std::array<glm::dvec3, 3>& corner) {
  return glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
}

std::uint32_t numberInScene(const radiosity::Scene& scene, std::uint32_t surface, std::uint32_t triangle) {
  for (std::uint32_t s = 0; s < surface; ++s)
    triangle += static_cast<std::uint32_t>(scene.surfaces[s].triangles.size());
  return triangle;
}

}  // namespace

RaySource pointRaySource(const radiosity::Scene& scene, std::uint32_t surface, const radiosity::SurfacePoint& point) {
  const auto [a, b, c] = inFrame(scene, scene.surfaces[surface].triangles[point.triangle]);
  const glm::dvec3 near = inFrame(scene, point.position);
  const glm::dvec3 inPlane = near - glm::dot(near - a, point.normal) * point.normal;
  const glm::dvec3 inward = (a + b + c) / 3.0 - inPlane;
  const double distance = glm::length(inward);
  const glm::dvec3 start = inPlane + (distance > 0 ? std::min(0.5, moveIntoTriangle / distance) : 0) * inward;
  return {{{{start, start, start}, point.normal, numberInScene(scene, surface, point.triangle)}}, {1.0}};
}

RaySource areaRaySource(const SurfacePieces& pieces, std::span<const std::uint32_t> elements) {
  RaySource raySource;
  double sum = 0;
  for (const std::uint32_t element : elements)
    for (const SurfacePiece& piece : pieces.of(element))
      for (std::size_t i = 2; i < piece.corner.size(); ++i) {
        raySource.triangles.push_back(
            {{piece.corner[0], piece.corner[i - 1], piece.corner[i]}, piece.normal, piece.triangle});
        raySource.upTo.push_back(sum += doubledArea(raySource.triangles.back().corner));
      }
  assert(sum > 0);
  for (double& share : raySource.upTo) share /= sum;
  return raySource;
}

std::vector<std::uint32_t> elementsOfPatch(const radiosity::Discretization& discretization, std::uint32_t patch) {
  const radiosity::Patch& block = discretization.patches[patch];
  const auto first = discretization.patchElements.begin() + block.firstElement;
  return {first, first + block.elementCount};
}

std::vector<std::uint32_t> elementsOfSurface(const radiosity::Discretization& discretization, std::uint32_t surface) {
  std::vector<std::uint32_t> elements(discretization.grids[surface].elementCount);
  std::iota(elements.begin(), elements.end(), discretization.grids[surface].firstElement);
  return elements;
}

/// A triangle gets an interval of x in proportion to its area. There the square is mapped so that one side collapses to
/// a corner.
ShootingPoint shootingPoint(const RaySource& raySource, double x, double y) {
  const auto found = std::upper_bound(raySource.upTo.begin(), std::prev(raySource.upTo.end()), x);
  const double before = found == raySource.upTo.begin() ? 0 : *std::prev(found);
  const ShootingTriangle& triangle = raySource.triangles[static_cast<std::size_t>(found - raySource.upTo.begin())];
  const auto& [a, b, c] = triangle.corner;
  const double along = std::sqrt((x - before) / (*found - before));
  return {a + along * ((b - a) + y * (c - b)), triangle.normal, triangle.triangle};
}

}  // namespace hemitex::reference
