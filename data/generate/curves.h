/// Curved parts: sheets of triangles with a chart of their own, and circles that need no library of functions: their
/// points come from square roots alone, which are the same on every machine.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// n points on the unit circle, counter-clockwise from (1, 0); n is 3, 4 or 5 times a power of two. Exact for the first
/// 3, 4 or 5; each doubling puts a point over the middle of every chord.
std::vector<glm::dvec2> circle(int n);

/// The points of the upper half, from (1, 0) to (-1, 0): n + 1 of them; 2 n is as in `circle`.
std::vector<glm::dvec2> halfCircle(int n);

/// Rows of points, all of the same length, as a sheet of two triangles a cell (one where two corners of it coincide).
/// As seen from the front a row runs to the right and the rows follow each other upwards. The chart is the grid itself:
/// columns and rows are as wide in it as they are on average on the sheet, and together they fill [0, 1]^2.
using Rows = std::vector<std::vector<glm::dvec3>>;
std::vector<Polygon> sheet(const Rows& rows);

/// A point of a profile: how far it is from the axis, and how high.
struct ProfilePoint {
  double radius = 0;
  double height = 0;
};

/// The sheet that a profile sweeps when it turns about the vertical axis through `foot`, over which its heights count,
/// in n steps. It faces to the right of the profile's way: outwards where that leads up.
std::vector<Polygon> revolved(const std::vector<ProfilePoint>& profile, int n, const glm::dvec3& foot);

/// A regular horizontal polygon of n corners that faces up, its first corner at +x.
Polygon disc(const glm::dvec3& centre, double radius, int n);

/// The vertical sheet from the outline `top`, a horizontal polygon that faces up, down to height y; it faces outwards.
std::vector<Polygon> band(const Polygon& top, double y);

/// The horizontal ring between two polygons that face up, the first corner by the first; the outer one has as many
/// corners as the inner one, or twice as many. It faces up. Flat, without coordinates.
std::vector<Polygon> ring(const Polygon& outer, const Polygon& inner);

/// A horizontal square with a round hole of n corners, a multiple of 8, about the same middle. It faces up. Flat,
/// without coordinates.
std::vector<Polygon> squareWithHole(const glm::dvec3& centre, double halfSide, double radius, int n);

/// All of them facing the other way.
std::vector<Polygon> reversed(const std::vector<Polygon>& polygons);

}  // namespace hemitex::data
