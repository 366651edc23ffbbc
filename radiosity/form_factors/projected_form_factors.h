/// Form-factor rows by projection: draws the scene on the faces over a point and sums the pixels.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
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

/// Lower limit for halving; below it, pixels of a hemicube are too wide.
inline constexpr int smallestResolution = 32;

struct ViewSettings {
  int resolution = 256;  ///< pixels along the side of a face; even, 2 to 4096
  Orientation orientation = Orientation::Aligned;
  ProjectionKind projection = ProjectionKind::Hemicube;
  /// Surfaces with fewer pixels per visible element than this use coarser index maps (see level_of_detail.h); 0: none.
  double pixelsPerElement = 0;
};

/// A point that a patch shoots from, with all that its row depends on besides the scene.
struct ViewPoint {
  std::uint32_t surface = 0;
  SurfacePoint point;
  glm::dvec3 up{0.0};  ///< direction of the upper side of the projection; 0: any (see facesOver)
  int halvings = 0;    ///< of the resolution, down to smallestResolution
  double area = 0;     ///< of the surface part that shoots from this point, in squared units of the scene

  bool operator==(const ViewPoint&) const = default;
};

/// All that is drawn for the row from one point.
struct View {
  const Projection* projection = nullptr;  ///< of the ProjectedFormFactors that made the view
  std::vector<raster::Face> faces;         ///< one per face of the projection, with the same scissor rectangles
  std::vector<std::uint32_t> skipped;      ///< see skippedTriangles
  double area = 0;                         ///< of the surface part that shoots from this point
};

class ProjectedFormFactors {
 public:
  /// All referenced objects must outlive this one.
  ProjectedFormFactors(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                       raster::ItemBufferRenderer& renderer, const ViewSettings& settings);

  /// The projection over patches that are not split.
  const Projection& projection() { return projectionAfter(0); }

  /// The row of form factors from a point of a surface. Light that the projection does not capture counts as
  /// background.
  FormFactorRow from(std::uint32_t surface, const SurfacePoint& point);
  /// The row of a patch: that of its points.
  FormFactorRow ofPatch(const Patch& patch);
  /// The shares of the flux of a lamp: those that elements and backs receive, and as background what leaves the scene.
  /// It is drawn with four times the resolution, because its shadows are sharp, but at most 2048 pixels. Lamps of
  /// different numbers are rotated by different angles. Throws InputError for a lamp too far away.
  FormFactorRow ofLamp(const Lamp& lamp, std::uint32_t number);
  /// The row from a point, or the mean over several points.
  FormFactorRow ofPoints(std::span<const ViewPoint> points);
  /// Such rows. A renderer that sums pixels draws all their views at once.
  std::vector<FormFactorRow> ofManyPoints(std::span<const std::vector<ViewPoint>> points);

  /// The points for the row of a patch: its centre, or each of its points. Patches that shoot little light use a
  /// coarser projection. The resolution is halved as often as the patch says.
  std::vector<ViewPoint> pointsOfPatch(const Patch& patch) const;
  /// The views from these points.
  std::vector<View> viewsOfPatch(const Patch& patch);
  /// The view from one point.
  View viewFrom(const ViewPoint& from);
  /// The row of one view.
  FormFactorRow ofView(const View& view);
  /// The sum of the pixels of windows of a view. It is their contribution to its row if isSumOfWindows.
  FormFactorRow ofWindows(const View& view, std::span<const Window> windows);

  /// Whether the row of a view is the sum of its windows. It is not with coarser maps, whose level is chosen per view.
  bool isSumOfWindows() const { return settings_.pixelsPerElement == 0; }
  /// Whether many views at once take less time (see raster::PixelSums).
  bool areFasterTogether() const { return sums_ != nullptr; }

 private:
  const Projection& projectionAfter(int halvings);
  std::vector<FormFactorRow> ofViews(std::span<const View> views);
  FormFactorRow drawnRow(const View& view);
  std::vector<std::size_t> addWeights(const Projection& projection);

  const Scene& scene_;
  const Discretization& discretization_;
  const IdLayout& layout_;
  raster::ItemBufferRenderer& renderer_;
  ViewSettings settings_;
  TriangleBoxes boxes_;
  std::map<int, Projection> projections_;  ///< by resolution, made on demand
  ItemBufferSum counter_;
  std::unique_ptr<raster::PixelSums> sums_;  ///< of the renderer; null if pixels are summed here
  /// The tables of each face of a projection in `sums_`; none if there is no room for them.
  std::map<const Projection*, std::vector<std::size_t>> weights_;
  std::vector<raster::ItemBuffer> buffers_;  ///< of the last view; the allocations are reused
};

}  // namespace hemitex::radiosity
