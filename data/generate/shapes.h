/// Shapes for models. Lengths are in the model's units and y points up; "from above" means from +y, with x to the right
/// and z towards the viewer.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// A horizontal rectangle that faces up: (x0, z1), (x1, z1), (x1, z0), (x0, z0).
Polygon rectangle(double x0, double x1, double z0, double z1, double y);

/// The polygon with opposite winding.
Polygon reversed(const Polygon& polygon);

/// The same polygon, moved along y to the given height.
Polygon atHeight(const Polygon& polygon, double y);

/// The vertical quads from each edge of `top`, a horizontal polygon that faces up, down to height y. They face
/// outwards and follow the edges of `top`: of a rectangle front (+z), right (+x), back (-z), left (-x).
std::vector<Polygon> sides(const Polygon& top, double y);

/// The groups wall-front, wall-right, wall-back and wall-left from the floor at y = 0 up to `ceiling`, a rectangle
/// that faces up; they face inwards. One material each.
std::vector<Group> walls(const Polygon& ceiling, const std::vector<std::string>& materials);

}  // namespace hemitex::data
