/// Where triangles cut through each other: for each triangle the segments in which others cross the plane just above
/// its front. What stands on a surface, or sinks into it, crosses this plane in its outline; what hovers does not.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/geometry/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A segment in the plane of a triangle, clipped to the triangle; in barycentric weights of its corners 1 and 2.
struct Slice {
  glm::dvec2 from, to;
};

/// The slices of every triangle of the scene, by the triangle's number in the scene. The plane lies `eyeLift` extents
/// above the triangle, as the eyes of its patches do; from there they are moved along what crosses it, onto the
/// triangle. Slices along the border of a surface are left out: they separate nothing. So are those along an edge by
/// the triangle's own neighbour there. Takes n log n for n triangles of about equal size, beside the slices themselves.
std::vector<std::vector<Slice>> triangleSlices(const Scene& scene);
/// The same with a tree of the scene at hand.
std::vector<std::vector<Slice>> triangleSlices(const Scene& scene, const RayTree& tree);

}  // namespace hemitex::radiosity
