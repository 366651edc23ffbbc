/// Rows of form factors by rays, the fast way that a renderer would take: Embree's own triangles in binary32, packets
/// of sixteen coherent rays, directions laid out once. What hemicubes are compared with at equal time, and a method of
/// its own where a solution asks for rays. It is no ground truth: that is RayFormFactors, slower by far.
///
/// Directions are a low-discrepancy sequence in projected solid angle, so each ray carries the same share of the light.
/// With a power of two of them that is an integer of units of 2^-60: a row sums to exactly one. To the 4,000 elements
/// of the Cornell box 2^16 rays err by 2 % of the light in all (the sum of |F - truth|), four times as many by 2.7
/// times less. Every patch turns the directions about its normal by an angle of its own, so that what one patch misses
/// the next one meets.
///
/// The start rule: as a hemicube's eye, a ray starts moved into its triangle by `eyeMove` and lifted off it by
/// `eyeLift` (radiosity/hemicube.h). That clears all that rounding to binary32 can do, by 2^-26 of the scene's extent
/// at a corner, so no ray meets the plane that it leaves, nor the back of a wall that rises from its start. What lies
/// lower than that is not seen: blockers and receivers within 5e-7 extents of the patch.
///
/// Backs of faces block, but for those whose twins stand for them. Of faces on each other any may be met, always the
/// same one in the same scene. The same bits for any number of threads; none are promised between machines.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/form_factors.h"
#include "radiosity/scene.h"
#include "reference/shooter.h"
#include "reference/surface_pieces.h"

namespace hemitex::reference {

/// Where on a patch its rays start.
enum class RayStart {
  Centre,  ///< all at radiosity::patchCentre, where its hemicube stands
  Area,    ///< spread evenly over it
};

struct RayRowSettings {
  int rays = 1 << 16;  ///< a row; a power of two, 16 to 2^24
  RayStart start = RayStart::Centre;
};

class RayRows {
 public:
  /// The scene and the discretization must outlive this one.
  RayRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
          const RayRowSettings& settings);
  ~RayRows();
  RayRows(const RayRows&) = delete;
  RayRows& operator=(const RayRows&) = delete;

  radiosity::FormFactorRow ofPatch(std::uint32_t patch);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::reference
