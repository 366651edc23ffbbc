/// Form factors to and from spheres, in closed form. Lengths are in any common unit; blockers are ignored.
#pragma once

namespace hemitex::tests {

/// From an element of area to the part of a sphere above the element's horizon. `cosine` is that of the angle theta
/// between the element's normal and the direction to the sphere's centre, in [-1, 1]; 0 < radius < distance.
///
/// Let sin(alpha) = radius / distance. A sphere completely above the horizon has F = sin^2(alpha) cos(theta). Otherwise
/// the contour of Lambert's integral (point_to_polygon.h) is an arc of the sphere's outline and an arc of the horizon.
/// Their half angles are phi and psi. With w^2 = sin^2(alpha) - cos^2(theta),
///
///   pi F = psi + phi sin^2(alpha) cos(theta) - w cos(alpha),
///   tan(psi) = w / cos(alpha),  tan(phi) = -w / (cos(alpha) cos(theta)).
///
/// The terms cancel if little is visible, so they are computed in 50 digits and rounded once. The relative error is
/// below 1e-9 for radii above 1e-8 of the distance, if at least 1e-15 of it is above the horizon. Source for the
/// completely visible sphere: Howell, Catalog of Radiation Heat Transfer Configuration Factors, section B. The other
/// case is derived here.
double elementToSphere(double radius, double distance, double cosine);

/// From a sphere to a disk that faces it; the axis of the disk passes through the sphere's centre, at a distance above
/// the sphere's radius:
///
///   F = (1 - 1 / sqrt(1 + (radius/distance)^2)) / 2 = radius^2 / (2 h (h + distance)),  h^2 = radius^2 + distance^2.
///
/// It is the share of all directions that the disk covers, for any size of the sphere. `radius` is that of the disk;
/// both arguments are above 0. The relative error is below 1e-15. Source: Howell, section C.
double sphereToCoaxialDisk(double radius, double distance);

}  // namespace hemitex::tests
