/// Contact: the parts of a triangle that lie in one place with other triangles, back to back or facing the same way.
///
/// A part is *backed* if a face that looks the other way lies on its back. Then its back is never visible, because a
/// view from there shows the other face. A part is *covered* if a face that looks the same way is shown in its place.
/// Of faces that look the same way the last one covers the others.
///
/// A solid that stands on a sheet or on the wall of a room backs nothing and covers nothing there. What is inside of it
/// is found elsewhere (discretization/exposure.h). The outer skin of a room does not stand on the walls of the room.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/geometry/shells.h"

namespace hemitex::radiosity {

struct Contact {
  bool isBacked = false;
  std::optional<std::uint32_t> coveredBy = {};  ///< the number of a triangle

  bool operator==(const Contact&) const = default;
};

/// A convex part of a triangle; its corners are barycentric weights of the triangle's corners 1 and 2,
/// counter-clockwise.
struct ContactPart {
  std::vector<glm::dvec2> corners;
  Contact contact;
};

/// The parts of triangle `number`, which fill it; one if all of it is in the same contact, and none without contact.
/// `near` has the numbers of triangles around it, in any order. Faces are in one place if they are parallel and at most
/// `tolerance` apart; corners within four times that distance of an edge lie on it. A triangle with more than 10,000
/// others that matter counts as without contact.
std::vector<ContactPart> contactParts(std::span<const TrianglePositions> triangles, const Shells& shells,
                                      std::uint32_t number, std::span<const std::uint32_t> near, double tolerance);

}  // namespace hemitex::radiosity
