/// Contact: the parts of a triangle that lie in one place with other triangles, back to back or facing the same way.
///
/// A part is *backed* if a face that looks the other way lies on its back. Then its back is never visible, because a
/// view from there shows the other face. A part is *covered* if a face that looks the same way is shown in its place.
/// Of faces that look the same way the one with the largest rank covers the others.
///
/// Closed solids that touch are *joined* there: what lies between them is inside of both together. It is cut off where
/// it reaches an edge of a triangle, so that no light from beyond the edge falls on it; not in
/// rooms, where no light comes from outside. Other parts of solids, and those
/// under a solid that stands on a sheet or on the wall of a room, are found elsewhere (discretization/exposure.h). Such
/// a solid backs nothing and covers nothing there. A skin, nearly all of which lies back to back with others, does not
/// stand on them; nor does the outer skin of a room on the walls of the room.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/geometry/shells.h"

namespace hemitex::radiosity {

/// A triangle by its number.
struct NumberedTriangle {
  std::uint32_t number;
  TrianglePositions positions;
};

/// A triangle in the place of another one: parallel to it, and with a point that both have.
struct FaceInPlace {
  std::uint32_t number;
  std::array<glm::dvec2, 3> corners;  ///< counter-clockwise as the first triangle is, in its weights
  bool isOpposite;
  double tolerance;      ///< up to which corners lie on edges
  glm::dvec2 low, high;  ///< the box around the corners
  double share;          ///< of the first triangle: the part that lies in the place of both
};

/// Those of the triangles `near` that are in the place of a triangle, ascending by number. They are parallel and at
/// most `tolerance` apart, and a 64th of the smaller height of both. Corners within four times that distance of an edge
/// lie on it.
std::vector<FaceInPlace> facesInPlace(const TrianglePositions& triangle, std::span<const NumberedTriangle> near,
                                      double tolerance);

struct Contact {
  bool isBacked = false;
  bool isJoined = false;                        ///< to another solid, so that it lies inside of both together
  std::optional<std::uint32_t> coveredBy = {};  ///< the number of a triangle

  bool operator==(const Contact&) const = default;
};

/// A convex part of a triangle; its corners are barycentric weights of the triangle's corners 1 and 2,
/// counter-clockwise.
struct ContactPart {
  std::vector<glm::dvec2> corners;
  Contact contact;
};

/// What decides between triangles in one place.
struct ContactRules {
  const Shells& shells;
  /// Of each shell: whether nearly all of it lies back to back with others that are no closed solids, as a skin.
  std::vector<bool> isSkin;
  std::vector<std::int64_t> ranks;  ///< of each triangle; the one with the largest rank covers the others
  /// Of each triangle: whether it lies in a room, where nothing is joined; empty if none does.
  std::vector<std::uint8_t> isIndoors = {};
};

/// The parts of triangle `number`, which fill it; one if all of it is in the same contact, and none without contact.
/// A triangle with more than 10,000 others that matter counts as without contact.
std::vector<ContactPart> contactParts(const TrianglePositions& triangle, std::uint32_t number,
                                      std::vector<FaceInPlace> others, const ContactRules& rules);

}  // namespace hemitex::radiosity
