/// Charts for meshes without texture coordinates. A mesh is divided into parts. The chart of a part is its projection
/// onto a plane, scaled so that its bounding rectangle becomes the unit square.
///
/// The u axis follows the longest boundary edge of the part; of edges equally long up to rounding, the first. A
/// boundary edge is an edge of one triangle of the part only. v = direction x u, where the plane's direction lies on
/// the front side of all triangles of the part. So charts are never mirrored.
///
/// Some triangles get a part of their own: those that would overlap in the chart (repeated faces) and those too thin to
/// have area in it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/geometry/chart_validation.h"
#include "radiosity/geometry/mesh_edges.h"

namespace hemitex::radiosity {

struct ChartedPart {
  std::vector<std::uint32_t> triangles;         ///< ascending
  std::vector<ChartTriangle> charts;            ///< one per triangle, rounded (see roundedChart), each with area
  std::optional<std::uint32_t> component = {};  ///< curvedParts: the number of its component, if that is curved
};

/// Scales charts so that their bounding rectangle, which must have area, becomes the unit square; rounded.
std::vector<ChartTriangle> scaledToSquare(std::vector<ChartTriangle> charts);

/// The unit normal of a triangle that has area.
glm::dvec3 unitNormal(const TrianglePositions& triangle);

/// Whether two unit normals differ by at most 1e-4 rad: their cross product is at most 1e-4 long.
bool areParallel(const glm::dvec3& a, const glm::dvec3& b);

/// Splits triangles into planar parts, ordered by their first triangles. A part grows from its first triangle over
/// edges, while normals are parallel to its first normal. All triangles must have area. `faces` has a number per
/// triangle; triangles with the same number are those of a polygon and do not overlap each other.
std::vector<ChartedPart> planarParts(std::span<const TrianglePositions> triangles,
                                     std::span<const std::uint32_t> faces);

/// Splits triangles into parts that may be curved, ordered by their first triangles. `edges` are those of `triangles`,
/// which must all have area; `faces` is as above.
///
/// The triangles that smooth edges connect form a component. If all its normals are parallel to the first, it is
/// planar. Otherwise directions are added (Gonzalez 1985), always the normal farthest from all directions so far, until
/// each normal is within 58 degrees of one; the first is the mean normal. Connected triangles with the same nearest
/// direction become a part. It takes in triangles of much smaller neighbours, as long as their normals are within 60
/// degrees of its direction. So no length on the surface is more than twice its length in the projection.
std::vector<ChartedPart> curvedParts(std::span<const TrianglePositions> triangles, const MeshEdges& edges,
                                     std::span<const std::uint32_t> faces, const Connects& isSmooth);

}  // namespace hemitex::radiosity
