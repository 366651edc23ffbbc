/// First hits of rays. Embree finds candidate triangles, and double precision decides which of them the ray meets.
///
/// Embree computes in binary32, which cannot resolve a gap of a millionth of the scene. So its geometry consists of
/// boxes (a user geometry), each larger than its triangle by more than the error of binary32. For each box that a ray
/// enters, Embree calls back. The callback uses the triangle's corners relative to the start of the ray and decides in
/// double precision. Two triangles with a common edge compute opposite values for it, so that no ray passes between
/// them. The order of callbacks, and hence the number of threads, does not change the result.
///
/// All positions are in the frame of the scene: the origin is the centre of its bounds, and the unit is its extent.
///
/// The epsilon rule: distances are rounded to the nearest multiple of epsilon. At distance 0 a ray meets nothing, and
/// it never meets the triangle that it starts on. At equal distances the first triangle in the scene's order wins, as
/// in item buffers.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// In extents of the scene, 9e-13. It is about 2^10 times the rounding error of a point on a triangle, and far below
/// the smallest supported gap.
inline constexpr double rayEpsilon = 0x1p-40;

struct Ray {
  glm::dvec3 start;            ///< in the frame of the scene
  glm::dvec3 direction;        ///< unit
  std::uint32_t triangle = 0;  ///< the triangle that it starts on, numbered through the scene (see triangleCount)
};

struct RayHit {
  std::uint32_t triangle = 0;  ///< numbered through the scene
  glm::dvec2 weights;          ///< barycentric, of the triangle's corners 1 and 2
  bool front = false;          ///< whether the ray meets the front, where the triangle is counter-clockwise
};

class RayCaster {
 public:
  /// Copies what it needs of the scene.
  explicit RayCaster(const radiosity::Scene& scene);

  /// The first triangle that a ray meets; nothing if the ray leaves the scene. In two-sided scenes rays pass through
  /// the backs of surfaces, which have twins. May be called from any thread.
  std::optional<RayHit> firstHit(const Ray& ray) const;

 private:
  struct Implementation;
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace hemitex::reference
