/// What light leaves from: a point, or an area that is sampled evenly.
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

/// A triangle that shoots, part of one of the scene; three equal corners make it a point.
struct ShootingTriangle {
  std::array<glm::dvec3, 3> corner;
  glm::dvec3 normal;           ///< unit
  std::uint32_t triangle = 0;  ///< of the scene
};

struct RaySource {
  std::vector<ShootingTriangle> triangles;
  std::vector<double> upTo;  ///< the share of the area of the triangles up to each and with it; the last is 1
};

/// A single point. It is put into the plane of its triangle, and moved towards the triangle's middle by 2^-30 extents,
/// so that no rounding leaves it behind a surface that touches it.
RaySource pointRaySource(const radiosity::Scene& scene, std::uint32_t surface, const radiosity::SurfacePoint& point);

/// The area of one or more elements together.
RaySource areaRaySource(const SurfacePieces& pieces, std::span<const std::uint32_t> elements);

/// The elements of a patch, and of a surface.
std::vector<std::uint32_t> elementsOfPatch(const radiosity::Discretization& discretization, std::uint32_t patch);
std::vector<std::uint32_t> elementsOfSurface(const radiosity::Discretization& discretization, std::uint32_t surface);

/// A point that light leaves from.
struct ShootingPoint {
  glm::dvec3 position;
  glm::dvec3 normal;           ///< unit
  std::uint32_t triangle = 0;  ///< of the scene
};

/// The point of a ray source that the point (x, y) of the unit square stands for; equal areas stand for equal areas.
ShootingPoint shootingPoint(const RaySource& raySource, double x, double y);

}  // namespace hemitex::reference
