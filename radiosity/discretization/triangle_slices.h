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

/// The slices of each triangle of the scene, by its number in the scene. The plane lies `eyeHeight` extents above the
/// triangle, like the eyes of its patches. The slices are then moved along the crossing triangles down to the triangle.
///
/// Slices along the border of a surface are left out, because they separate nothing; so are slices along an edge by the
/// neighbour at that edge, and slices by triangles of the same curved part. `tree` is that of the scene.
/// Takes O(n log n) time for n triangles of about equal size, plus the slices.
std::vector<std::vector<Slice>> triangleSlices(const Scene& scene, const RayTree& tree);

}  // namespace hemitex::radiosity
