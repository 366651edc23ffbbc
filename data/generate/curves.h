/// Curved parts: sheets of triangles with a chart, and circles without trigonometric functions. Their points are
/// computed with square roots only, which are the same on all machines.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// n points on the unit circle, counter-clockwise from (1, 0); n is 3, 4 or 5 times a power of two. The first 3, 4 or 5
/// are exact; each doubling adds a point above the middle of each chord.
std::vector<glm::dvec2> circle(int n);

/// The n + 1 points of the upper half, from (1, 0) to (-1, 0); 2 n is as in `circle`.
std::vector<glm::dvec2> halfCircle(int n);

/// Rows of points of equal length, converted to a sheet of two triangles per cell, or one if two corners coincide. Seen
/// from the front, a row runs to the right and the rows follow each other upwards. The chart is the grid itself. Its
/// columns and rows have their average widths on the sheet, and together they fill [0, 1]^2.
using Rows = std::vector<std::vector<glm::dvec3>>;
std::vector<Polygon> sheet(const Rows& rows);

/// A point of a profile: its distance from the axis, and its height.
struct ProfilePoint {
  double radius = 0;
  double height = 0;
};

/// The surface of revolution of a profile about the vertical axis through `foot`, in n steps; heights count from
/// `foot`. It faces to the right of the profile's direction: outwards if that leads up.
std::vector<Polygon> revolved(const std::vector<ProfilePoint>& profile, int n, const glm::dvec3& foot);

/// A regular horizontal polygon of n corners that faces up, with its first corner at +x.
Polygon disc(const glm::dvec3& centre, double radius, int n);

/// The vertical sheet from the outline `top`, a horizontal polygon that faces up, down to height y; it faces outwards.
std::vector<Polygon> band(const Polygon& top, double y);

/// The horizontal ring between two polygons that face up, starting at their first corners. The outer one has as many
/// corners as the inner one, or twice as many. The ring faces up and has no texture coordinates.
std::vector<Polygon> ring(const Polygon& outer, const Polygon& inner);

/// A horizontal square with a concentric round hole of n corners, a multiple of 8. It faces up and has no texture
/// coordinates.
std::vector<Polygon> squareWithHole(const glm::dvec3& centre, double halfSide, double radius, int n);

/// The polygons with opposite winding.
std::vector<Polygon> reversed(const std::vector<Polygon>& polygons);

}  // namespace hemitex::data
