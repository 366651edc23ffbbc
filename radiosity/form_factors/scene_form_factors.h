/// Form-factor rows of a discretized scene by drawing. It lays out item IDs and gives the draw list to a renderer. It
/// splits patches that are too near to their receivers before they shoot, and computes the row of each patch.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
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

class SceneFormFactors {
 public:
  /// `layout` is that of the discretization. The scene must outlive this object. Splitting always uses textures, also
  /// if meshes are drawn, so that patches do not depend on `elementsBy`.
  SceneFormFactors(const Scene& scene, Discretization unsplit, IdLayout layout, const DrawingSettings& settings,
                   const RendererFactory& makeRenderer = softwareRenderer);
  SceneFormFactors(const SceneFormFactors&) = delete;
  SceneFormFactors& operator=(const SceneFormFactors&) = delete;

  /// The discretization with split patches; elements are unchanged.
  const Discretization& discretization() const { return discretization_; }
  /// Moves it out. This object must not be used afterwards.
  Discretization takeDiscretization() { return std::move(discretization_); }
  /// Splits all patches with weight 1.
  void splitAll();
  /// The function that splits patches of `discretization()` during a solution; empty if no patch is to be split. Keeps
  /// a reference to this object.
  PatchSplit splits();
  /// The points that a patch would shoot from now with this weight; none if it would be split (see PatchSplit).
  std::vector<ViewPoint> likelyPoints(std::uint32_t patch, double weight);
  const IdLayout& layout() const { return layout_; }
  ProjectedFormFactors& rows() { return rows_; }
  /// The flux from `scene.outside`, with eight times as many directions as a face has pixels along its side,
  /// or fewer for scenes of more than 2^17 triangles.
  OutsideFlux outsideFlux();

 private:
  const Scene& scene_;
  int directions_;
  IdLayout layout_;
  Discretization discretization_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  ProjectedFormFactors rows_;
  std::unique_ptr<raster::ItemBufferRenderer>
      textures_;  ///< renderer for split tests, if rows are drawn in another way
  std::optional<PatchSubdivision> splitter_;
};

}  // namespace hemitex::radiosity
