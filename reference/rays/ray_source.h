/// The source of rays: a point, or an area that is sampled uniformly.
///
/// Positions are in the frame of the scene (see ray_caster.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "reference/closed_forms/surface_pieces.h"

namespace hemitex::reference {

/// A source triangle, part of one of the scene; with three equal corners it is a point.
struct ShootingTriangle {
  std::array<glm::dvec3, 3> corner;
  glm::dvec3 normal;           ///< unit
  std::uint32_t triangle = 0;  ///< number in the scene
};

struct RaySource {
  std::vector<ShootingTriangle> triangles;
  std::vector<double> upTo;  ///< cumulative share of the area of the triangles; the last is 1
};

/// A single point. It is projected to the plane of its triangle and moved towards the triangle's middle by 2^-30
/// extents. So rounding cannot put it behind a surface that touches it.
RaySource pointRaySource(const radiosity::Scene& scene, std::uint32_t surface, const radiosity::SurfacePoint& point);

/// The area of one or more elements.
RaySource areaRaySource(const SurfacePieces& pieces, std::span<const std::uint32_t> elements);

/// The elements of a patch, and of a surface.
std::vector<std::uint32_t> elementsOfPatch(const radiosity::Discretization& discretization, std::uint32_t patch);
std::vector<std::uint32_t> elementsOfSurface(const radiosity::Discretization& discretization, std::uint32_t surface);

/// A point that light leaves from.
struct ShootingPoint {
  glm::dvec3 position;
  glm::dvec3 normal;           ///< unit
  std::uint32_t triangle = 0;  ///< number in the scene
};

/// Maps a point (x, y) of the unit square to a point of a ray source; equal areas map to equal areas.
ShootingPoint shootingPoint(const RaySource& raySource, double x, double y);

}  // namespace hemitex::reference
