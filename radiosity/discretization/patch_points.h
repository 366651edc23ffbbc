/// The points that a patch shoots from: its centre, or the centres of the blocks that it is divided into.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A point on a surface, its normal, and the triangle that contains it.
struct SurfacePoint {
  glm::dvec3 position;         ///< in units of the file
  glm::dvec3 normal;           ///< unit
  std::uint32_t triangle = 0;  ///< in Surface::triangles

  bool operator==(const SurfacePoint&) const = default;
};

/// In extents of the scene. Where surfaces meet at the shooting point, rounding of positions to binary32 must not put
/// the eye behind one of them. So the eye is moved into its triangle and lifted off it. The lift is enough for shallow
/// concave folds, the move for all but the sharpest folds.
inline constexpr double eyeInset = 0x1p-19;
inline constexpr double eyeHeight = 0x1p-21;
/// The same lengths in units of the file: contactTolerance, and four times as much. The latter is also the distance up
/// to which outlines count as one. Both are longer where coordinates are rounded more.
inline double outlineTolerance(const Scene& scene) { return eyeInset / eyeHeight * contactTolerance(scene); }
/// Instead of the number of a surface: the point is on none that is known, such as that of a sensor.
inline constexpr std::uint32_t noSurface = UINT32_MAX;
/// The eye of a view from a point of a surface or of none, in units of the file (see eyeInset).
glm::dvec3 eyeOver(const Scene& scene, std::uint32_t surface, const SurfacePoint& point);

/// The point of a triangle with these barycentric weights of its corners 1 and 2.
SurfacePoint pointOn(const Surface& surface, std::uint32_t triangle, const glm::dvec2& weights);

/// The centre of a patch: the centroid, in the chart, of the exposed part of its block. If that point is not exposed, a
/// point of the nearest exposed piece. Where the block is curved, only pieces count whose normal is nearest to the mean
/// normal, because a patch sends light around its normal. Always on the surface.
SurfacePoint patchCentre(const Scene& scene, const Discretization& discretization, const Patch& patch);

/// The centre of an element: the point of the surface at the middle of its own texel or leaf. If the chart does not
/// cover that, the centroid of the largest piece of the surface inside. If the texel or leaf is partly buried, the
/// centroid of the exposed part. If that centroid is not exposed, a point of the nearest exposed piece. Always on the
/// surface.
SurfacePoint elementCentre(const Scene& scene, const Discretization& discretization, std::uint32_t element);

/// The unit mean normals of the elements of a surface, by area; one per element. 0 where normals cancel.
std::vector<glm::dvec3> meanNormals(const Surface& surface, const Grid& grid);

/// The centres of elements with their normals; on a curved surface the mean normals. The scene and the discretization
/// must outlive the function. Any thread may call it.
std::function<SurfacePoint(std::uint32_t element)> elementPlaces(const Scene& scene,
                                                                 const Discretization& discretization);

/// A point that a part of the area of a surface shoots from.
struct ShootingBlock {
  SurfacePoint centre;  ///< see patchCentre
  double area = 0;      ///< of the exposed surface inside the block, above 0
};

/// The block of a rectangle of a surface's chart, in texels of its grid; nothing if there is no exposed area. Visits
/// all triangles of the surface.
std::optional<ShootingBlock> shootingBlock(const Surface& surface, const Grid& grid, const glm::dvec2& corner,
                                           const glm::dvec2& size);

/// The points x points blocks of a patch, row by row, without blocks that have no area.
std::vector<ShootingBlock> shootingBlocks(const Scene& scene, const Discretization& discretization, const Patch& patch);

}  // namespace hemitex::radiosity
