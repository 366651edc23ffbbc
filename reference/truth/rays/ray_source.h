/// The source of rays: a point, or an area that is sampled uniformly.
///
/// A point (x, y) of the unit square maps to a point of the area, so that equal areas map to equal areas. Points of low
/// discrepancy keep it where neighbours of the square are neighbours on the area. So the map inverts cumulative
/// distributions over the chart of the surface. First x chooses a texel column, and y chooses a texel of the column.
/// Then x chooses a vertical line in the texel, and y chooses a point on the parts of the line inside the area. For a
/// parallelogram of any number of texels and triangles that is the affine map.
///
/// Vertical lines through the corners of all pieces divide a texel into slabs, and each piece into trapezoids
/// (trapezoidal decomposition). In a slab, the length of a line's parts changes linearly with its place.
///
/// Positions are in the frame of the scene (see ray_meeting.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "reference/truth/closed_forms/surface_pieces.h"

namespace hemitex::reference {

/// Part of a triangle of the scene. Its sides at the left and right border of a slab are parallel, and may be points.
struct ShootingTrapezoid {
  std::array<glm::dvec3, 2> low, high;  ///< ends of the left and of the right side
  /// Area per width of the slab at its left and right border, of this and all previous trapezoids of the slab.
  std::array<double, 2> upTo;
  glm::dvec3 normal;           ///< unit
  std::uint32_t triangle = 0;  ///< number in the scene
};

/// Members of the next level: the texels of a column, the slabs of a texel, the trapezoids of a slab.
struct ShootingRange {
  double upTo = 0;                   ///< area of this range and of all previous ranges that are members of the same one
  std::uint32_t begin = 0, end = 0;  ///< indices of the first member and of the one after the last
};

/// A point is one trapezoid whose corners are equal.
struct RaySource {
  std::vector<ShootingRange> columns, texels, slabs;
  std::vector<ShootingTrapezoid> trapezoids;
};

/// A single point. It is projected to the plane of its triangle and moved towards the triangle's middle by 2^-30
/// extents. So rounding cannot put it behind a surface that touches it.
RaySource pointRaySource(const radiosity::Scene& scene, std::uint32_t surface, const radiosity::SurfacePoint& point);

/// The area of one or more elements, in any order. Columns are in the order of surfaces.
RaySource areaRaySource(const SurfacePieces& pieces, std::span<const std::uint32_t> elements);

/// The elements of a surface.
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
