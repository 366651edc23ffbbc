/// Closes T-junctions: where faces share an edge, the vertices of one must be vertices of the other, or rounding would
/// open a gap between them. Models may be built from independent parts and closed afterwards.
#pragma once

#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// Rounds each coordinate to the nearest multiple of 1 / `steps`.
glm::dvec3 roundedPosition(const glm::dvec3& position, double steps);

/// Rounds all positions to multiples of 1 / `steps`, so that adjacent parts meet exactly. Inserts each vertex that lies
/// inside an edge of another face into that edge, and triangulates the faces with inserted vertices. So polygons stay
/// convex, and none has three collinear corners. Texture coordinates are interpolated.
void closeSeams(std::vector<Group>& groups, double steps);

}  // namespace hemitex::data
