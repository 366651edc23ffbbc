/// Form factors to and from spheres, in closed form. Lengths are in any one unit; blockers are not looked at.
#pragma once

namespace hemitex::reference {

/// From an element of area to a sphere, as far as it is above the element's horizon. `cosine` is that of the angle
/// theta between the element's normal and the direction to the sphere's centre, in [-1, 1]; 0 < radius < distance.
///
/// With sin(alpha) = radius / distance, a sphere that is all above the horizon has F = sin^2(alpha) cos(theta). Else
/// the contour of Lambert's integral (point_to_polygon.h) is an arc of the sphere's outline and an arc of the horizon,
/// of the half angles phi and psi about their middles. With w^2 = sin^2(alpha) - cos^2(theta),
///
///   pi F = psi + phi sin^2(alpha) cos(theta) - w cos(alpha),
///   tan(psi) = w / cos(alpha),  tan(phi) = -w / (cos(alpha) cos(theta)).
///
/// The terms cancel where little is seen, so they are evaluated in 50 digits and rounded once: the relative error is
/// below 1e-9 for radii above 1e-8 of the distance, of which at least 1e-15 is above the horizon. Source: Howell,
/// Catalog of Radiation Heat Transfer Configuration Factors, section B, for the wholly visible sphere; derived here for
/// the other.
double elementToSphere(double radius, double distance, double cosine);

/// From a sphere to a disk that faces it, the axis of the disk through the sphere's centre, at any distance above the
/// sphere's radius:
///
///   F = (1 - 1 / sqrt(1 + (radius/distance)^2)) / 2 = radius^2 / (2 h (h + distance)),  h^2 = radius^2 + distance^2.
///
/// It is the share of all directions that the disk fills, whatever the sphere's size. `radius` is the disk's; both
/// above 0. The relative error is below 1e-15. Source: Howell, section C.
double sphereToCoaxialDisk(double radius, double distance);

}  // namespace hemitex::reference
