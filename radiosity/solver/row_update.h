/// What of a row changes where objects of a scene come, go or move. From a point that stays where it was, only pixels
/// of the objects' old and new places can show something else. So windows of the faces, which bound these places, are
/// drawn in the scene before and in the scene after; the rest of the row is what it was, to the last unit of 2^-60.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/scene/scene.h"
#include "raster/culling/triangle_cluster.h"
#include "raster/interface/draw_list.h"

namespace hemitex::radiosity {

/// Some surfaces of a scene, at the places where they come, or are gone from.
class ChangedSurfaces {
 public:
  /// `isChanged` is one a surface.
  ChangedSurfaces(const Scene& scene, const std::vector<bool>& isChanged);

  bool empty() const { return clusters_.empty(); }
  /// An upper bound of the share of a point's light that goes through pixels which the surfaces can cover: of the cone
  /// around a sphere that holds them, wider by a pixel (a sphere seen under the half angle a takes sin^2 a at most).
  /// 0 where they lie behind the point.
  double largestShare(const SurfacePoint& point, double pixelAngle) const;
  /// The window of a face that they can cover; without width and height where there is none.
  raster::Scissor windowOf(const raster::Face& face) const;

 private:
  raster::DrawList list_;
  std::vector<raster::Cluster> clusters_;
  glm::dvec3 low_, high_;  ///< their bounds, in the file's units
};

/// No pixel of a projection is seen under a larger angle from corner to corner, in radians.
double pixelAngle(const Projection& projection);

/// The parts of a row that differ: what it had there before, and what it has there now. Outside of them the row before
/// and the row after are alike.
struct RowChange {
  FormFactorRow before, after;
  bool isWhole = false;    ///< they are whole rows
  bool isRounded = false;  ///< they are parts of means, which are rounded as a whole: to a few units of 2^-60
  std::vector<RowChange> views = {};  ///< then: of each view that the mean is over
  bool isNothing() const { return before.elements.empty() && before.background == 0 && before.back == 0; }
};

/// The scene before an edit and the scene after it, and the surfaces that are not in both or not at the same place.
struct SceneChange {
  ProjectedFormFactors& rowsBefore;
  ProjectedFormFactors& rowsAfter;
  ChangedSurfaces gone, come;
};

/// Of a patch that is in both scenes, at the same place. A view is drawn whole where the near distance differs, which
/// moves vertices where triangles cross the near plane; `known` is the row before, where it is known.
RowChange changeOf(SceneChange& change, std::uint32_t patchBefore, std::uint32_t patchAfter,
                   const FormFactorRow* known = nullptr);

}  // namespace hemitex::radiosity
