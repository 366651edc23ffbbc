/// Walls with openings. A wall is a vertical plane with coordinates: s along it, to the right as seen from the front, y
/// upwards, and a depth behind its face.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

struct Wall {
  glm::dvec3 origin{0.0};
  glm::dvec3 along{1, 0, 0};  ///< unit, horizontal

  glm::dvec3 at(double s, double y, double depth = 0) const {
    return origin + s * along + glm::dvec3(0, y, 0) - depth * glm::cross(along, glm::dvec3(0, 1, 0));
  }
};

/// A rectangle on a wall or any other plane, from left to right and from bottom to top.
struct Rectangle {
  double left = 0, right = 0, bottom = 0, top = 0;
};

/// The rest of a rectangle after cutting out holes, which do not overlap: the cells between the lines along all their
/// sides.
std::vector<Rectangle> cutOut(const Rectangle& whole, const std::vector<Rectangle>& holes);

Polygon panel(const Wall& wall, const Rectangle& rectangle, double depth = 0);
std::vector<Polygon> panels(const Wall& wall, const std::vector<Rectangle>& rectangles, double depth = 0);

/// An opening with a round head of `segments` segments. It reaches `radius` to both sides of s = `centre`, and from the
/// sill straight up to the spring of the arch.
struct Arch {
  double centre = 0, radius = 1, sill = 0, spring = 0;
  int segments = 16;
};

/// Points of a wall as (s, y).
using Outline = std::vector<glm::dvec2>;

/// From the right end of the sill counter-clockwise to the left one.
Outline outline(const Arch& arch);
/// All four corners, from the lower left one counter-clockwise.
Outline outline(const Rectangle& rectangle);

/// The part of a wall inside `rectangle` around an arch that springs from its lower edge or stands on it: the arch's
/// sill is the bottom of the rectangle.
std::vector<Polygon> aroundArch(const Wall& wall, const Rectangle& rectangle, const Arch& arch);

/// A sheet along an outline, from the face of the wall to this depth, facing into the opening. It ends where the
/// outline does, unless it is `closed`.
std::vector<Polygon> reveal(const Wall& wall, Outline outline, double depth, bool closed);

/// The polygon of an outline at some depth.
Polygon pane(const Wall& wall, const Outline& outline, double depth);

}  // namespace hemitex::data
