/// The view of a projection over a point of a surface: eye position, rotation, near distance and skipped triangles.
/// They prevent that a surface sees itself and that rounding puts surfaces in front of the eye.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/geometry/nearest_boxes.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Consecutive triangles of one surface at one instance; the first has the number `number` in space.
struct TriangleRange {
  std::uint32_t instance = 0, surface = 0;
  std::uint32_t first = 0, end = 0;  ///< in the surface
  std::uint32_t number = 0;
};

/// All triangles in space in boxes, so that a view visits only those of its own surface, those near to its point, and
/// surfaces with backed triangles.
struct TriangleBoxes {
  std::vector<TriangleRange> ranges;      ///< in the order of the triangles
  std::vector<SpaceBox> boxes;            ///< one around each range
  std::vector<std::uint32_t> firstRange;  ///< of each surface, instance by instance; one more at the end
  std::vector<std::uint32_t> backed;      ///< the surfaces with backed triangles: places in firstRange, ascending
  NearestBoxes nearest;                   ///< over the boxes
};

TriangleBoxes triangleBoxes(const Scene& scene);

/// In extents of the scene: triangles of the shooting surface lie in the tangent plane if their corners are this close
/// to it. A few units of binary32 roundoff, which is the limit of what drawing can resolve.
inline constexpr double tangentPlaneTolerance = 0x1p-20;
/// Minimum near distance in extents of the scene; binary32 positions have no detail below it.
inline constexpr double smallestNearDistance = 0x1p-24;

/// The triangles that a view from a point of a surface skips, ascending: those of the surface and its twin in the
/// tangent plane, and backed ones that face away from the point. `boxes` are triangleBoxes of the scene.
std::vector<std::uint32_t> skippedTriangles(const Scene& scene, const TriangleBoxes& boxes, std::uint32_t surface,
                                            const SurfacePoint& point);

/// The triangles whose backs face an eye, ascending: all, or only those that are backed.
std::vector<std::uint32_t> trianglesFacingAway(const Scene& scene, const glm::dvec3& eye, bool onlyBacked = false);

/// A near distance that clips no visible triangle: the distance to the nearest triangle that is not skipped, divided by
/// the projection's reach (see Projection::squaredReach). It is smallestNearDistance if a triangle touches the point,
/// and the scene's extent if no triangle is near. `point` and the result are in units of the file, `skipped` is
/// ascending and `boxes` are triangleBoxes of the scene.
double nearDistance(const Scene& scene, const TriangleBoxes& boxes, const glm::dvec3& point,
                    const std::vector<std::uint32_t>& skipped, double squaredReach);

/// The rotation of projections over patches.
enum class Orientation {
  Aligned,  ///< the same for all patches
  Turned,  ///< rotated per patch about the normal, so that a surface between the pixels of one patch is hit by those of
           ///< the next; with equal rotations, patches along an axis could all miss it
};

/// The rotation of the projection over a point of a patch, as a share of a quarter turn in [0, 1). Multiples of the
/// golden section leave no large gap for any count (Weyl 1916); the faces of a hemicube repeat after a quarter turn.
double turnOf(std::uint32_t patch, int point);

/// The up direction (of any length) of the projection over a point of a patch with this unit normal, for
/// ViewPoint::up; zero if all have the same rotation.
glm::dvec3 upOf(Orientation orientation, const glm::dvec3& normal, std::uint32_t patch, int point);

}  // namespace hemitex::radiosity
