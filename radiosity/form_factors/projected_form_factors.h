/// Rows of form factors by projection: the scene is drawn on the faces over a point, and what their pixels show is
/// counted.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/item_buffer_sum.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/projection/patch_view.h"
#include "radiosity/projection/projection.h"
#include "radiosity/projection/projection_kinds.h"
#include "raster/interface/face.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// Halving stops here: below, a hemicube's pixels are as wide as what it is to tell apart.
inline constexpr int smallestResolution = 32;

struct ViewSettings {
  int resolution = 256;  ///< pixels along the side of a face; even, 2 to 4096
  Orientation orientation = Orientation::Aligned;
  ProjectionKind projection = ProjectionKind::Hemicube;
  /// Where a surface covers fewer pixels than this for each of its elements in view, coarser index maps are used (see
  /// level_of_detail.h); 0: nowhere.
  double pixelsPerElement = 0;
};

/// All that is drawn for the row from one point.
struct View {
  const Projection* projection = nullptr;  ///< of the ProjectedFormFactors that it came from
  std::vector<raster::Face> faces;         ///< one a face of the projection, with the same scissor rectangles
  std::vector<std::uint32_t> skipped;      ///< see skippedTriangles
  double area = 0;                         ///< of the surface that shoots from there
};

class ProjectedFormFactors {
 public:
  /// All referenced objects must outlive this one.
  ProjectedFormFactors(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                       raster::ItemBufferRenderer& renderer, const ViewSettings& settings);

  /// What stands over patches that are not split.
  const Projection& projection() { return projectionAfter(0); }

  /// The row of form factors from a point of a surface. What the projection does not capture counts as background.
  FormFactorRow from(std::uint32_t surface, const SurfacePoint& point);
  /// The row of a patch: of its only view, or the mean over its views.
  FormFactorRow ofPatch(std::uint32_t patch);

  /// The views that the row of a patch is found from: of its centre or, where it shoots from several points, of each
  /// of them. Where little light is shot from a point a coarser projection does: the resolution is halved as often
  /// as the patch says, down to smallestResolution.
  std::vector<View> viewsOfPatch(std::uint32_t patch);
  /// The row of one view.
  FormFactorRow ofView(const View& view);
  /// What windows of a view add to its row, as long as isSumOfWindows.
  FormFactorRow ofWindows(const View& view, std::span<const Window> windows);

  /// Whether the windows of a view add up to its row: the level of coarser maps is chosen for whole views.
  bool isSumOfWindows() const { return settings_.pixelsPerElement == 0; }

 private:
  /// Draws the windows, one buffer per window, and returns the sum of their pixels.
  FormFactorRow drawWindows(const View& view, std::span<const Window> windows,
                            std::vector<raster::ItemBuffer>& buffers);
  View viewFrom(std::uint32_t surface, const SurfacePoint& point, const glm::dvec3& up, int halvings, double area);
  const Projection& projectionAfter(int halvings);

  const Scene& scene_;
  const Discretization& discretization_;
  const IdLayout& layout_;
  raster::ItemBufferRenderer& renderer_;
  ViewSettings settings_;
  std::vector<TriangleBox> boxes_;
  std::map<int, Projection> projections_;  ///< by resolution, made when first asked for
  ItemBufferSum counter_;
  std::vector<raster::ItemBuffer> buffers_;  ///< their memory is reused from view to view
};

}  // namespace hemitex::radiosity
