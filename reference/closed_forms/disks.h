/// Form factors to disks, in closed form.
///
/// The textbook's formulas subtract numbers that grow equal as the disk gets small or far. Here they are rearranged so
/// that only positive numbers are added, but for differences of the lengths given: the relative error is below 1e-14
/// whatever the lengths. They use, for a point at a distance `offset` from the axis and `gap` from the plane,
///
///   W^2 = (gap^2 + (offset - radius)^2) (gap^2 + (offset + radius)^2),
///
/// the product of the squared distances to the nearest and to the farthest point of the rim.
///
/// Lengths are in any one unit. Blockers are not looked at.
#pragma once

namespace hemitex::reference {

/// From a disk of radius `from` to a disk of radius `to` that faces it on the same axis:
///
///   F = 2 to^2 / (from^2 + to^2 + gap^2 + W),  W as above with offset = from and radius = to.
///
/// All above 0. Source: Howell, Catalog of Radiation Heat Transfer Configuration Factors, C-41:
/// (S - sqrt(S^2 - 4 (to/from)^2)) / 2, S = 1 + (gap^2 + to^2) / from^2.
double coaxialDisks(double from, double to, double gap);

/// From an element of area to a disk in a parallel plane, the two facing each other. With k = offset^2 + gap^2 -
/// radius^2,
///
///   F = (1 - k/W) / 2;  where k > 0 rearranged to 2 radius^2 gap^2 / (W (W + k)).
///
/// radius and gap above 0, offset at least 0. Source: Howell, section B; radius^2 / (radius^2 + gap^2) on the axis.
double elementToParallelDisk(double radius, double gap, double offset);

/// From an element of area that faces the axis of a disk to that disk, in a plane perpendicular to the element's. With
/// k = offset^2 + gap^2 + radius^2,
///
///   F = gap/(2 offset) (k/W - 1) = 2 offset gap radius^2 / (W (W + k)).
///
/// radius and gap above 0, offset at least the radius: the whole disk is in front of the element. Source: Howell,
/// section B.
double elementToPerpendicularDisk(double radius, double gap, double offset);

}  // namespace hemitex::reference
