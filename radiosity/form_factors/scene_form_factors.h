/// Rows found by drawing, from a discretized scene on: its item IDs laid out, its draw list handed to a renderer,
/// patches split that are too near to what they light when they are about to shoot, and every patch's row counted from
/// what is drawn.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/patch_subdivision.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// What elements are drawn by.
enum class ElementsBy {
  Texture,  ///< an index map over each surface (makeDrawList)
  Mesh,     ///< a polygon each (makeMeshedDraws)
};

/// How patches look at the scene.
struct DrawingSettings {
  int resolution = 256;  ///< pixels along the side of a face; even, 2 to 4096
  Orientation orientation = Orientation::Turned;
  double split = defaultMaxMisdirected;  ///< see splitPatches; 1 or more splits none
  ElementsBy elementsBy = ElementsBy::Texture;
  ProjectionKind projection = ProjectionKind::Hemicube;
  double pixelsPerElement = 0;  ///< see ViewSettings
};

/// Makes the renderer of a draw list.
using RendererFactory = std::function<std::unique_ptr<raster::ItemBufferRenderer>(raster::DrawList)>;

/// The reference renderer (raster/software/software_renderer.h).
std::unique_ptr<raster::ItemBufferRenderer> softwareRenderer(raster::DrawList list);

/// A renderer of the scene, whose triangles it leaves out by their numbers in the scene.
std::unique_ptr<raster::ItemBufferRenderer> sceneRenderer(const Scene& scene, const Discretization& discretization,
                                                          const IdLayout& layout, ElementsBy elementsBy,
                                                          const RendererFactory& makeRenderer = softwareRenderer);

class SceneFormFactors {
 public:
  /// `layout` is that of the discretization. The scene must outlive this. Which patches are split, textures say,
  /// also where meshes are drawn, so that the patches do not depend on it.
  SceneFormFactors(const Scene& scene, Discretization unsplit, IdLayout layout, const DrawingSettings& settings,
                   const RendererFactory& makeRenderer = softwareRenderer);
  SceneFormFactors(const SceneFormFactors&) = delete;
  SceneFormFactors& operator=(const SceneFormFactors&) = delete;

  /// Patches that were split are replaced by their parts; elements are what they were.
  const Discretization& discretization() const { return discretization_; }
  /// Splits all patches as if they had weight 1.
  void splitAll();
  /// What splits patches of `discretization()` on the way to a solution; nothing where none is to be split. Refers to
  /// this.
  PatchSplit splits();
  const IdLayout& layout() const { return layout_; }
  ProjectedFormFactors& rows() { return rows_; }

 private:
  IdLayout layout_;
  Discretization discretization_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  ProjectedFormFactors rows_;
  std::unique_ptr<raster::ItemBufferRenderer> textures_;  ///< what splits are judged by, where rows are drawn otherwise
  std::optional<PatchSubdivision> splitter_;
};

}  // namespace hemitex::radiosity
