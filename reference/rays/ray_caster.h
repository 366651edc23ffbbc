/// What a ray meets first: Embree finds the triangles that it comes near, binary64 decides which of them it meets.
///
/// Embree computes in binary32, which has no digits left for a gap of a millionth of the scene. So it is given boxes (a
/// user geometry), each larger than its triangle by more than binary32 can be wrong, and asks back about each box
/// that a ray enters. There the triangle's corners are taken relative to the start of the ray and everything is
/// decided in binary64. Two triangles with a common edge compute the same number for it but for the sign, so no ray
/// slips between them; and no order in which boxes are asked for, hence no number of threads, changes an answer.
///
/// Everything is in the frame of the scene: origin at the centre of its bounds, lengths in its extent.
///
/// The epsilon rule: a distance counts as its nearest multiple of epsilon. At distance 0 a ray meets nothing, nor does
/// it meet the triangle that it starts on; of equal distances the triangle first in the scene's order is met, as in the
/// item buffers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// In extents of the scene, 9e-13: some 2^10 times what rounding can move a point off its triangle, and far below the
/// smallest gap that a scene is asked about.
inline constexpr double rayEpsilon = 0x1p-40;

struct Ray {
  glm::dvec3 start;            ///< in the frame of the scene
  glm::dvec3 direction;        ///< unit
  std::uint32_t triangle = 0;  ///< that it starts on, numbered through the scene (see triangleCount)
};

struct RayHit {
  std::uint32_t triangle = 0;  ///< numbered through the scene
  glm::dvec2 weights;          ///< barycentric, of the triangle's corners 1 and 2
  bool front = false;          ///< whether it is met on the side from which it winds counter-clockwise
};

class RayCaster {
 public:
  /// Keeps what it needs of the scene.
  explicit RayCaster(const radiosity::Scene& scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// The triangle that a ray meets first; nothing where it leaves the scene. In two-sided scenes it passes through the
  /// backs of surfaces, whose twins stand for them. May be called from any thread.
  std::optional<RayHit> firstHit(const Ray& ray) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::reference
