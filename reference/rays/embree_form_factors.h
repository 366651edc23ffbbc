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
/// `eyeLift` (radiosity/projection/patch_view.h). That clears all that rounding to binary32 can do, by 2^-26 of the
/// scene's extent at a corner, so no ray meets the plane that it leaves, nor the back of a wall that rises from its
/// start. What lies lower than that is not seen: blockers and receivers within 5e-7 extents of the patch.
///
/// Backs of faces block, but for those whose twins stand for them. The same bits for any number of threads; none are
/// promised between machines.
///
/// What rays miss:
/// - A receiver of less light than one ray: mostly it gets nothing, rarely all that a ray carries. Of 200 receivers of
///   1e-8 of the light 2^16 rays meet none, 2^20 one, 2^24 28. Of the elements that a patch of the Cornell box sees,
///   2^17 rays miss 4 %, with 2e-4 of the light; a hemicube of 256 pixels misses as many.
/// - Slivers narrower than 1e-6 extents, which binary32 thins: to 85 % of their light at 1e-7, 71 % at 3e-8.
/// - Faces on each other: whichever Embree's rounding puts first, in turned scenes a speckle of both. It is always the
///   same in the same scene.
/// - Hardly a gap between triangles that share an edge: of 4e8 rays in closed rooms none slips out, of as many aimed at
///   edges three, between 200,000 triangles. Without Embree's robust flag it would be one in 10^6, and 1 to 3 % at
///   edges.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/scene/scene.h"
#include "reference/closed_forms/surface_pieces.h"
#include "reference/rays/ray_source.h"

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
