/// Form factors of axis-parallel rectangles, in closed form.
///
/// The kernel of the form factor, cos cos / (pi r^2), has an antiderivative in all its variables. The form factor
/// between two such rectangles is the sum, with alternating signs, of that antiderivative at the 16 pairs of their
/// corners. For a point and a rectangle it is the sum at the 4 corners. The sums cancel: for rectangles of sides a, b,
/// c, d at a distance r, about lg(r^4 / (abcd)) digits are lost. That is all digits of a double for unit squares 10^4
/// apart. So the sums are computed in 50 digits and rounded once. The relative error is below 1e-9 if r^4 / (abcd) is
/// below 1e36. It is about 1e-16 below 1e30 (slivers of 1 : 1e-6 at 10^4 times their length: 1e28).
///
/// Lengths are in any common unit. Blockers are ignored.
#pragma once

namespace hemitex::tests {

struct Interval {
  double low, high;  ///< low < high
};

/// A rectangle in a plane; the function defines the plane and the names of the two axes.
struct AxisRectangle {
  Interval first, second;
};

/// From the rectangle `from` (x, y) in the plane z = 0, facing up, to `to` (x, y) in the plane z = gap, facing down.
/// With u and v the differences of the corners' x and y, and z the gap,
///
///   area F = sum +-G(u, v),
///   G = 1/(2 pi) { u p atan(u/p) + v q atan(v/q) - z^2/2 ln(u^2 + v^2 + z^2) },  p^2 = v^2 + z^2,  q^2 = u^2 + z^2.
///
/// gap > 0. Source: Howell, Catalog of Radiation Heat Transfer Configuration Factors, C-11 for equal opposite
/// rectangles. In general: Ehlert and Smith, View factors for perpendicular and parallel rectangular plates, Journal of
/// Thermophysics and Heat Transfer 7 (1993).
double parallelRectangles(const AxisRectangle& from, const AxisRectangle& to, double gap);

/// From the rectangle `from` (x, y) in the plane z = 0, facing up, to `to` (x, z) in the plane y = 0, facing along y.
/// With u the difference of the corners' x, and s^2 = y^2 + z^2,
///
///   area F = sum +-H(u, s),  H = 1/(2 pi) { u s atan(u/s) + (u^2 - s^2)/4 ln(u^2 + s^2) }.
///
/// The y and z are at least 0; if both start at 0, the rectangles may share an edge. Source: Howell C-14 for rectangles
/// with a common edge; in general, Ehlert and Smith 1993.
double perpendicularRectangles(const AxisRectangle& from, const AxisRectangle& to);

/// From an element of area at the origin, facing along z, to the rectangle (x, y) in the plane z = distance, facing it.
/// The term of a corner at x = a, y = b is, with p^2 = a^2 + z^2 and q^2 = b^2 + z^2,
///
///   1/(2 pi) { a/p atan(b/p) + b/q atan(a/q) }.
///
/// distance > 0. Source: Siegel and Howell, Thermal Radiation Heat Transfer.
double elementToParallelRectangle(const AxisRectangle& to, double distance);

/// From an element of area at the origin, facing along z, to the rectangle (x, z) in the plane y = distance, facing it.
/// The term of a corner at x = b, z = a is, with c the distance and p^2 = a^2 + c^2,
///
///   -c/(2 pi p) atan(b/p);
///
/// the corners on the horizon (a = 0) give the book's term atan(b/c). distance > 0, z at least 0. Source: Howell B-4.
double elementToPerpendicularRectangle(const AxisRectangle& to, double distance);

}  // namespace hemitex::tests
