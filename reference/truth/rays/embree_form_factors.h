/// Form-factor rows by rays, as a fast renderer computes them: Embree's triangles in binary32, packets of sixteen
/// coherent rays, and one set of directions. Hemicubes are compared with it at equal time, and solutions can use it as
/// a method. It is not the ground truth; that is RayFormFactors, which is far slower.
///
/// Directions are a low-discrepancy sequence in projected solid angle, so that each ray carries the same share of the
/// light. For a power of two that is an integer in units of 2^-60, and a row sums to exactly one. For the 4,000
/// elements of the Cornell box the sum of |F - truth| is 2 % with 2^16 rays. With four times as many it is 2.7 times
/// less. Each patch rotates the directions about its normal by its own angle, so that the next patch meets what one
/// patch misses.
///
/// The start of a ray is moved into its triangle by `eyeInset` and lifted off it by `eyeHeight`, as the eye of a
/// hemicube (radiosity/projection/patch_view.h). That exceeds the rounding of corners to binary32, which is 2^-26 of
/// the scene's extent. So no ray meets the plane that it leaves, or the back of a wall that rises from its start. Lower
/// objects are not seen: blockers and receivers within 5e-7 extents of the patch.
///
/// Backs of faces block, except those with a twin. The results have the same bits for any number of threads, but not on
/// different machines.
///
/// Rays miss the following:
/// - Receivers of less light than one ray carries. They usually get nothing, and rarely all the light of a ray. Of 200
///   receivers of 1e-8 of the light, 2^16 rays meet none, 2^20 meet one, and 2^24 meet 28. Of the elements visible from
///   a patch of the Cornell box, 2^17 rays miss 4 %, with 2e-4 of the light. A hemicube of 256 pixels misses as many.
/// - Slivers narrower than 1e-6 extents, which become thinner in binary32: to 85 % of their light at 1e-7, 71 % at
///   3e-8.
/// - One of two coincident faces. Embree's rounding decides which one, and in rotated scenes both appear in speckles.
///   The result is always the same for the same scene.
/// - Very few gaps between triangles that share an edge. Of 4e8 rays in closed rooms none escapes; of as many aimed at
///   edges three do, between 200,000 triangles. Without Embree's robust flag it is one in 10^6, and 1 to 3 % at edges.
#pragma once

#include <cstdint>
#include <memory>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/scene/scene.h"
#include "reference/truth/closed_forms/surface_pieces.h"
#include "reference/truth/rays/ray_source.h"

namespace hemitex::reference {

/// The starts of rays on a patch.
enum class RayStart {
  Centre,  ///< all at radiosity::patchCentre, like its hemicube
  Area,    ///< distributed uniformly over it
};

struct RayRowSettings {
  int rays = 1 << 16;  ///< per row; a power of two, 16 to 2^24
  RayStart start = RayStart::Centre;
  std::uint32_t seed = 0;  ///< of the sequence of directions and starts (see sample_points.h)
};

class RayRows {
 public:
  /// The scene and the discretization must outlive this object.
  RayRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
          const RayRowSettings& settings);
  ~RayRows();
  RayRows(const RayRows&) = delete;
  RayRows& operator=(const RayRows&) = delete;

  radiosity::FormFactorRow ofPatch(const radiosity::Patch& patch);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::reference
