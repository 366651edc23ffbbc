/// Form-factor rows of a discretized scene by drawing: gives the draw list to a renderer, finds the parts of patches
/// that are too near to their receivers, and computes the row of each patch.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/near_receivers.h"
#include "radiosity/form_factors/outside_flux.h"
#include "radiosity/form_factors/patch_subdivision.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// How elements are drawn.
enum class ElementsBy {
  Texture,  ///< with an index map over each surface (makeDrawList)
  Mesh,     ///< with one polygon each (makeMeshedDraws)
};

/// Settings of the views of patches.
struct DrawingSettings {
  int resolution = 256;  ///< pixels along the side of a face; even, 2 to 4096
  Orientation orientation = Orientation::Turned;
  double split = defaultMaxMisdirected;  ///< see PatchSubdivision; with 1 or more no patch is split
  ElementsBy elementsBy = ElementsBy::Texture;
  ProjectionKind projection = ProjectionKind::Hemicube;
  double pixelsPerElement = 0;  ///< see ViewSettings
};

/// Makes the renderer of a draw list.
using RendererFactory = std::function<std::unique_ptr<raster::ItemBufferRenderer>(raster::DrawList)>;

/// The reference renderer (raster/software/software_renderer.h).
std::unique_ptr<raster::ItemBufferRenderer> softwareRenderer(raster::DrawList list);

/// A renderer of the scene; skipped triangles are numbers in the scene.
std::unique_ptr<raster::ItemBufferRenderer> sceneRenderer(const Scene& scene, const Discretization& discretization,
                                                          const IdLayout& layout, ElementsBy elementsBy,
                                                          const RendererFactory& makeRenderer = softwareRenderer);

/// The patches after all are split with weight 1; without `split` as they are.
Patches splitAll(Patches patches, const PatchSplit& split);

class SceneFormFactors {
 public:
  /// `layout` is that of the discretization, whose patches are not used. The scene and the discretization must
  /// outlive this object. Splitting always uses textures, also if meshes are drawn, so that patches do not depend on
  /// `elementsBy`.
  SceneFormFactors(const Scene& scene, const Discretization& discretization, IdLayout layout,
                   const DrawingSettings& settings, const RendererFactory& makeRenderer = softwareRenderer);
  SceneFormFactors(const SceneFormFactors&) = delete;
  SceneFormFactors& operator=(const SceneFormFactors&) = delete;

  /// The row of a patch: drawn from its points, and corrected.
  FormFactorRow row(const Patch& patch);
  /// The rows of patches, drawn together.
  std::vector<FormFactorRow> rows(std::span<const Patch> patches);
  /// As `row`. Keeps a reference to this object.
  RowSource rowOf();
  /// A row that was drawn for a patch, with the shares of elements near it replaced (see NearReceivers); nothing
  /// if there are none, or if no patch is to be split.
  std::optional<FormFactorRow> corrected(const Patch& patch, const FormFactorRow& drawn);
  /// Null if no patch is to be split.
  NearReceivers* near() { return near_ ? &*near_ : nullptr; }
  /// The parts of patches during a solution; empty if no patch is to be split. Keeps a reference to this object.
  PatchSplit splits();
  /// The rows of low resolution that decide how patches are split; empty if no patch is to be split. Keeps a reference
  /// to this object.
  RowSource scoutRows();
  /// The points that a patch would shoot from now with this weight; none if it would be split (see PatchSplit).
  std::vector<ViewPoint> likelyPoints(const Patches& patches, Patch patch, double weight);
  const IdLayout& layout() const { return layout_; }
  /// What is drawn for rows, before they are corrected.
  ProjectedFormFactors& uncorrected() { return rows_; }
  /// The flux from `scene.outside` and from `scene.lamps`. That from outside is drawn with eight times as many
  /// directions as a face has pixels along its side, or fewer for scenes of many triangles (see affordableViews). What
  /// counts of it is found at 64 elements, by rows of low resolution.
  OutsideFlux outsideFlux();

 private:
  OutsideFlux fluxFromOutside();
  double countedShare(const OutsideFlux& flux);

  const Scene& scene_;
  const Discretization& discretization_;
  const IdLayout layout_;
  int directions_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  ProjectedFormFactors rows_;
  std::unique_ptr<raster::ItemBufferRenderer>
      textures_;  ///< renderer for split tests, if rows are drawn in another way
  std::optional<PatchSubdivision> splitter_;
  std::optional<NearReceivers> near_;
};

}  // namespace hemitex::radiosity
