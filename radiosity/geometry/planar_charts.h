/// Planar parts: charts for surfaces without texture coordinates.
///
/// A part grows from its first triangle over edges whose two ends have equal positions, while normals stay within 1e-4
/// rad of the first normal. (The cross product of the unit normals is at most 1e-4 long.) The chart of a part is its
/// bounding rectangle in the plane of the first triangle. The u axis follows the longest boundary edge; of edges
/// equally long up to rounding, the first. v = normal x u, and both are scaled to [0,1]. So charts are never mirrored.
/// A boundary edge is an edge of one triangle of the part only.
///
/// Some triangles get a part of their own: those that would overlap in the chart (repeated faces) and those too thin to
/// have area in it.
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
  std::vector<ChartTriangle> charts;     ///< one per triangle, rounded (see roundedChart), each with area
};

/// Splits triangles into planar parts, ordered by their first triangles. All triangles must have area.
std::vector<PlanarPart> planarParts(std::span<const TrianglePositions> triangles);

}  // namespace hemitex::radiosity
