/// Form factors to disks, in closed form.
///
/// The textbook formulas subtract numbers that become equal for small or distant disks. Here the formulas are
/// rearranged to add only positive numbers, except for differences of the given lengths. So the relative error is below
/// 1e-14 for all lengths. For a point at a distance `offset` from the axis and `gap` from the plane, they use
///
///   W^2 = (gap^2 + (offset - radius)^2) (gap^2 + (offset + radius)^2),
///
/// the product of the squared distances to the nearest and to the farthest point of the rim.
///
/// Lengths are in any common unit. Blockers are ignored.
#pragma once

namespace hemitex::tests {

/// From a disk of radius `from` to a disk of radius `to` that faces it on the same axis:
///
///   F = 2 to^2 / (from^2 + to^2 + gap^2 + W),  W as above with offset = from and radius = to.
///
/// All arguments are above 0. Source: Howell, Catalog of Radiation Heat Transfer Configuration Factors, C-41: (S -
/// sqrt(S^2 - 4 (to/from)^2)) / 2, S = 1 + (gap^2 + to^2) / from^2.
double coaxialDisks(double from, double to, double gap);

/// From an element of area to a disk in a parallel plane, facing each other. With k = offset^2 + gap^2 - radius^2,
///
///   F = (1 - k/W) / 2;  where k > 0 rearranged to 2 radius^2 gap^2 / (W (W + k)).
///
/// `radius` and `gap` are above 0, `offset` is at least 0. Source: Howell, section B; radius^2 / (radius^2 + gap^2) on
/// the axis.
double elementToParallelDisk(double radius, double gap, double offset);

/// From an element of area that faces the axis of a disk to that disk; the planes are perpendicular. With k = offset^2
/// + gap^2 + radius^2,
///
///   F = gap/(2 offset) (k/W - 1) = 2 offset gap radius^2 / (W (W + k)).
///
/// `radius` and `gap` are above 0. `offset` is at least the radius, so that the whole disk is in front of the element.
/// Source: Howell, section B.
double elementToPerpendicularDisk(double radius, double gap, double offset);

}  // namespace hemitex::tests
