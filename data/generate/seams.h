/// Seams: where faces touch along an edge, the vertices of one have to be vertices of the other, or rounding would tear
/// a gap between them. Whoever builds of parts need not think of it: the seams are closed afterwards.
#pragma once

#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// Each coordinate as the nearest multiple of 1 / `steps`.
glm::dvec3 roundedPosition(const glm::dvec3& position, double steps);

/// Rounds every position to multiples of 1 / `steps`, so that parts that meet do so exactly, puts each vertex that lies
/// inside an edge of another face into that edge, and cuts the faces that got such vertices into triangles: polygons
/// are convex and stay so, but none has three corners in a line. Texture coordinates follow.
void closeSeams(std::vector<Group>& groups, double steps);

}  // namespace hemitex::data
