/// Planar parts: the charts of a surface that brings none along.
///
/// A part grows from its first triangle over edges whose two ends are equal positions, as long as the normals stay
/// within 1e-4 rad of the first one's (the cross product of unit normals is at most 1e-4 long). Its chart is its
/// bounding rectangle in the plane of the first triangle, with u along the longest boundary edge (the first of those
/// that are as long to within rounding), v = normal x u, and both stretched to [0,1]: never mirrored. A boundary edge
/// belongs to one triangle of the part only.
/// Triangles that would claim a place of the chart twice (a face that stands in the file twice), or that are too thin
/// to have area in it, go into a part of their own.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/geometry/chart_validation.h"

namespace hemitex::radiosity {

using TrianglePositions = std::array<glm::dvec3, 3>;

struct PlanarPart {
  std::vector<std::uint32_t> triangles;  ///< ascending
  std::vector<ChartTriangle> charts;     ///< one a triangle, rounded (see roundedChart); none is without area
};

/// Splits triangles, all with area, into planar parts, ordered by their first triangles.
std::vector<PlanarPart> planarParts(std::span<const TrianglePositions> triangles);

}  // namespace hemitex::radiosity
