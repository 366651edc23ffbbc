/// Decides in double precision which triangles a ray meets, and which of them is first. Two triangles with a common
/// edge compute opposite values for it, so that no ray passes between them. The order in which triangles are asked does
/// not change the result.
///
/// All positions are in the frame of the scene: the origin is the centre of its bounds, and the unit is its extent.
///
/// The epsilon rule: distances are rounded to the nearest multiple of epsilon. At distance 0 a ray meets nothing, and
/// it never meets the triangle that it starts on. At equal distances the first triangle in the scene's order wins, as
/// in item buffers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// In extents of the scene, 9e-13. It is about 2^10 times the rounding error of a point on a triangle, and far below
/// the smallest supported gap.
inline constexpr double rayEpsilon = 0x1p-40;

struct Ray {
  glm::dvec3 start;            ///< in the frame of the scene
  glm::dvec3 direction;        ///< unit
  std::uint32_t triangle = 0;  ///< the triangle that it starts on, by its number in space
};

struct RayHit {
  std::uint32_t triangle = 0;  ///< by its number in space (see placedTriangleCount)
  glm::dvec2 weights;          ///< barycentric, of the triangle's corners 1 and 2
  bool front = false;          ///< whether the ray meets the front, where the triangle is counter-clockwise
};

/// A triangle that rays may meet.
struct Target {
  std::array<glm::dvec3, 3> corner;                            ///< in the frame of the scene
  bool isBacked = false;                                       ///< rays pass through its back
  std::shared_ptr<const radiosity::HoledTriangle> holed = {};  ///< rays pass through its holes; null without
};

/// The triangles in space, in the order of their numbers.
std::vector<Target> targetsOf(const radiosity::Scene& scene);

/// A ray and the first hit among the targets asked so far.
struct RayQuery {
  Ray ray;
  std::optional<RayHit> hit = std::nullopt;
  double distance = std::numeric_limits<double>::infinity();  ///< to the hit, in epsilons

  /// Asks the target with this number. Returns whether it is the first hit so far.
  bool ask(const Target& target, std::uint32_t number);
};

/// The first hit among all targets, which are asked one after the other.
std::optional<RayHit> nearestHit(std::span<const Target> targets, const Ray& ray);

}  // namespace hemitex::reference
