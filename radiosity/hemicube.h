/// The hemicube (Cohen and Greenberg 1985): half a cube over a patch's centre, whose pixels stand for directions. An
/// item buffer on its five faces says what is seen in each; the delta form factor of a pixel says how much flux goes
/// there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/form_factors.h"
#include "radiosity/word_layout.h"
#include "raster/face.h"
#include "raster/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// The delta form factors of a hemicube with resolution x resolution pixels on its top face, in units of 2^-60. They
/// are the integrals of cos(theta)/pi over each pixel's solid angle, rounded so that all five faces sum to exactly
/// 2^60. By symmetry one quadrant of the top and one half of a side say all.
class DeltaFormFactors {
 public:
  /// `resolution` is even, 2 to 4096.
  explicit DeltaFormFactors(int resolution);

  int resolution() const { return resolution_; }
  /// Pixel (column, row) of the top face, both in [0, resolution).
  std::uint64_t top(int column, int row) const;
  /// Pixel (column, row) of a side face; row 0, up to resolution / 2 - 1, stands on the horizon.
  std::uint64_t side(int column, int row) const;

 private:
  int resolution_;
  std::vector<std::uint64_t> top_, side_;
};

/// The five faces over a point: top, then the sides that look along the top's +x, +y, -x and -y, rows growing
/// away from the horizon; all determinants are 1. `position` is relative to the scene's origin, `normal` is
/// unit; `up`, where it is not zero, turns the hemicube about the normal so that the top face's rows run along it.
std::array<raster::Face, 5> hemicubeFaces(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& up,
                                          double nearDistance, int resolution);

/// Triangles of the shooting surface whose corners lie this close to the tangent plane, in extents of the scene, lie
/// in it: a few units of binary32's roundoff, which is all that drawing them could show.
inline constexpr double tangentPlaneTolerance = 0x1p-20;
/// Where surfaces meet at the shooting point, the rounding of positions to binary32 must not put the eye behind one of
/// them: it is moved into its triangle and lifted off it, by so many extents of the scene. The lift clears shallow
/// concave folds, the move all but the sharpest ones.
inline constexpr double eyeMove = 0x1p-19;
inline constexpr double eyeLift = 0x1p-21;
/// Halving stops here: below, a hemicube's pixels are as wide as what it is to tell apart.
inline constexpr int smallestResolution = 16;
/// A near distance is never below this many extents of the scene: binary32 positions have no detail there.
inline constexpr double smallestNearDistance = 0x1p-24;

/// The triangles that a hemicube at a point of a surface leaves out, ascending: those of the surface that lie in the
/// tangent plane, and in two-sided scenes whichever of two coincident sides faces away from the point.
std::vector<std::uint32_t> skippedTriangles(const Scene& scene, std::uint32_t surface, const SurfacePoint& point);

/// A near distance that clips no triangle open: the distance to the nearest triangle that is not skipped, over
/// sqrt(3), since the face that sees a point at distance d sees it at depth d / sqrt(3) or more. Where a triangle
/// touches the point it is smallestNearDistance, where nothing is near the scene's extent.
double nearDistance(const Scene& scene, const glm::dvec3& point, const std::vector<std::uint32_t>& skipped);

/// How hemicubes stand over patches.
enum class Orientation {
  Aligned,  ///< all alike
  Turned,   ///< each turned about its normal by an angle of its own: what falls between the pixels of one patch meets
            ///< those of the next, instead of being missed by all that see it from along the same axis
};

/// Where along a quarter turn a patch's hemicube stands, in [0, 1): multiples of the golden section, which leave no
/// large gap however many of them there are (Weyl 1916; the faces repeat after a quarter).
double turnOf(std::uint32_t patch, int point);

/// Counts item buffers into rows: words to elements through the layout and the spill tables, pixels to shares.
class HemicubeRows {
 public:
  /// All referenced objects must outlive this one.
  HemicubeRows(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
               raster::ItemBufferRenderer& renderer, int resolution, Orientation orientation = Orientation::Aligned);

  /// The row of form factors from a point of a surface.
  FormFactorRow from(std::uint32_t surface, const SurfacePoint& point);
  /// The row of a patch, from its centre or as the mean of its points. A part of a split patch shoots less light, so
  /// that coarser hemicubes do: the resolution is halved as often as the side was, down to smallestResolution.
  FormFactorRow ofPatch(std::uint32_t patch);

 private:
  FormFactorRow draw(std::uint32_t surface, const SurfacePoint& point, const glm::dvec3& up, int halvings);
  glm::dvec3 eyeOver(std::uint32_t surface, const SurfacePoint& point) const;
  FormFactorRow count(const std::vector<raster::ItemBuffer>& faces, const DeltaFormFactors& deltas);
  const DeltaFormFactors& deltasAfter(int halvings);

  const Scene& scene_;
  const Discretization& discretization_;
  const WordLayout& layout_;
  raster::ItemBufferRenderer& renderer_;
  int resolution_;
  Orientation orientation_;
  std::map<int, DeltaFormFactors> deltas_;  ///< by resolution, made when first asked for
  std::vector<std::uint64_t> share_;        ///< one an element, all 0 between rows
};

}  // namespace hemitex::radiosity
