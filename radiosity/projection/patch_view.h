/// Where a projection stands over a point of a surface: the eye, which way it is turned, and what is left out, so that
/// a surface does not see itself and rounding puts nothing between.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/projection/triangle_boxes.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Triangles of the shooting surface whose corners lie this close to the tangent plane, in extents of the scene, lie
/// in it: a few units of binary32's roundoff, which is all that drawing them could show.
inline constexpr double tangentPlaneTolerance = 0x1p-20;
/// Where surfaces meet at the shooting point, the rounding of positions to binary32 must not put the eye behind one of
/// them: it is moved into its triangle and lifted off it, by so many extents of the scene. The lift clears shallow
/// concave folds, the move all but the sharpest ones.
inline constexpr double eyeMove = 0x1p-19;
inline constexpr double eyeLift = 0x1p-21;
/// A near distance is never below this many extents of the scene: binary32 positions have no detail there.
inline constexpr double smallestNearDistance = 0x1p-24;

/// The triangles that a view from a point of a surface leaves out, ascending: those of the surface that lie in the
/// tangent plane, and in two-sided scenes whichever of two coincident sides faces away from the point.
std::vector<std::uint32_t> skippedTriangles(const Scene& scene, std::uint32_t surface, const SurfacePoint& point);
/// The same with the scene's triangleBoxes at hand, for who asks often.
std::vector<std::uint32_t> skippedTriangles(const Scene& scene, std::span<const TriangleBox> boxes,
                                            std::uint32_t surface, const SurfacePoint& point);

/// A near distance that clips no triangle open: the distance to the nearest triangle that is not skipped, over the
/// projection's reach (see Projection::squaredReach). Where a triangle touches the point it is smallestNearDistance,
/// where nothing is near the scene's extent.
double nearDistance(const Scene& scene, const glm::dvec3& point, const std::vector<std::uint32_t>& skipped,
                    double squaredReach);
/// Likewise with the boxes at hand.
double nearDistance(const Scene& scene, std::span<const TriangleBox> boxes, const glm::dvec3& point,
                    const std::vector<std::uint32_t>& skipped, double squaredReach);

/// The eye of a view from a point of a surface, in the file's units (see eyeMove).
glm::dvec3 eyeOver(const Scene& scene, std::uint32_t surface, const SurfacePoint& point);

/// How projections stand over patches.
enum class Orientation {
  Aligned,  ///< all alike
  Turned,   ///< each turned about its normal by an angle of its own: what falls between the pixels of one patch meets
            ///< those of the next, instead of being missed by all that see it from along the same axis
};

/// Where along a quarter turn the projection over a point of a patch stands, in [0, 1): multiples of the golden
/// section, which leave no large gap however many of them there are (Weyl 1916; a hemicube's faces repeat after a
/// quarter).
double turnOf(std::uint32_t patch, int point);

/// The direction that the projection over a point of a patch has up; zero where all stand alike.
glm::dvec3 upOf(Orientation orientation, const glm::dvec3& normal, std::uint32_t patch, int point);

}  // namespace hemitex::radiosity
