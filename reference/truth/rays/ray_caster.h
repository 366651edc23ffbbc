/// First hits of rays. Embree finds candidate triangles, and double precision decides which of them the ray meets (see
/// ray_meeting.h).
///
/// Embree computes in binary32, which cannot resolve a gap of a millionth of the scene. So its geometry consists of
/// boxes (a user geometry), each larger than its triangle by more than the error of binary32. For each box that a ray
/// enters, Embree calls back. The callback uses the triangle's corners relative to the start of the ray and decides in
/// double precision. The order of callbacks, and hence the number of threads, does not change the result.
///
/// In builds without Embree, every_triangle/ray_caster.cpp gives the same hits.
#pragma once

#include <memory>
#include <optional>

#include "radiosity/scene/scene.h"
#include "reference/truth/rays/ray_meeting.h"

namespace hemitex::reference {

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
