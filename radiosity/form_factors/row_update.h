/// The change of a form-factor row when objects are added, removed or moved. From a point that stays at its place, only
/// pixels of the old and new places of the objects can change. So windows of the faces that bound these places are
/// drawn in the scenes before and after. The rest of the row is unchanged, to the last unit of 2^-60.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/scene/scene.h"
#include "raster/culling/triangle_cluster.h"
#include "raster/interface/draw_list.h"

namespace hemitex::radiosity {

/// The changed surfaces of a scene: those that appear or disappear in it, including moved ones.
class ChangedSurfaces {
 public:
  /// `isChanged` has one entry per surface.
  ChangedSurfaces(const Scene& scene, const std::vector<bool>& isChanged);

  bool empty() const { return clusters_.empty(); }
  /// An upper bound of the share of a point's light through pixels that the surfaces can cover. It is the share of the
  /// cone around their bounding sphere, enlarged by one pixel. (A sphere seen under the half angle a takes at most
  /// sin^2 a.) 0 if the surfaces lie behind the point.
  double largestShare(const SurfacePoint& point, double pixelAngle) const;
  /// The distance of a point from their bounds, in units of the file; infinite if there are none.
  double distanceFrom(const glm::dvec3& point) const;
  /// The window of a face that they can cover; its width and height are 0 if there is none.
  raster::Scissor windowOf(const raster::Face& face) const;

 private:
  raster::DrawList list_;
  std::vector<raster::Cluster> clusters_;
  glm::dvec3 low_, high_;  ///< their bounds, in units of the file
};

/// The largest angle between two corners of a pixel of a projection, in radians.
double pixelAngle(const Projection& projection);

/// The parts of a row that differ, before and after. Elsewhere both rows are equal.
struct RowChange {
  FormFactorRow before, after;
  bool isWhole = false;    ///< both are complete rows
  bool isRounded = false;  ///< both are parts of means, which are rounded as a whole: accurate to a few units of 2^-60
  std::vector<RowChange> views = {};  ///< of each view of the mean, if isRounded
  bool isNothing() const { return before.elements.empty() && before.background == 0 && before.back == 0; }
};

/// Whether two views have the same faces.
bool areSameViews(const View& a, const View& b);

/// The scenes before and after an edit, and the surfaces that exist, or lie, only in one of them.
struct SceneChange {
  ProjectedFormFactors& rowsBefore;
  ProjectedFormFactors& rowsAfter;
  ChangedSurfaces gone, come;
};

/// The windows of a view that the changed surfaces can cover.
std::vector<Window> windowsOf(const SceneChange& change, const View& view);

/// The change of the row of a patch that is at the same place in both scenes, with its numbers before and after. A view
/// is drawn completely if its near distance differs, because that moves vertices where triangles cross the near plane.
/// `known` is the row before, if known.
RowChange changeOf(SceneChange& change, const Patch& patchBefore, const Patch& patchAfter,
                   const FormFactorRow* known = nullptr);

}  // namespace hemitex::radiosity
