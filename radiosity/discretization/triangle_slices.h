/// Intersections of triangles: for each triangle, the segments in which others cross the plane just above its front. An
/// object that stands on a surface or sinks into it crosses this plane in its outline. A hovering object does not.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A segment in the plane of a triangle, clipped to the triangle; in barycentric weights of its corners 1 and 2.
struct Slice {
  glm::dvec2 from, to;
};

/// Opposite faces at the same place touch if the cosine of the angle between them is at least this [.9 to .999999].
inline constexpr double touchingCosine = 0.999;

struct SceneSlices {
  std::vector<std::vector<Slice>> ofTriangle;  ///< by the number of the triangle in the scene
  /// One per surface: whether a triangle of it may touch one of another surface back to back. Its middle is in contact
  /// with the plane of the other, and their boxes meet.
  std::vector<bool> isTouching;
};

/// The slices of all triangles. The plane lies a contactTolerance above the triangle, like the eyes of its patches. The
/// slices are then moved along the crossing triangles down to the triangle.
///
/// Slices along the border of a surface are left out, because they separate nothing; so are slices along an edge by the
/// neighbour at that edge, and slices by triangles of the same curved part. `tree` is that of the scene.
/// Takes O(n log n) time for n triangles of about equal size, plus the slices.
SceneSlices triangleSlices(const Scene& scene, const RayTree& tree);

}  // namespace hemitex::radiosity
