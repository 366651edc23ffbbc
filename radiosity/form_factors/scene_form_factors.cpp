#include "radiosity/form_factors/scene_form_factors.h"

#include <algorithm>
#include <utility>

#include "radiosity/index_maps/meshed_draws.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/software/software_renderer.h"

namespace hemitex::radiosity {
std::unique_ptr<raster::ItemBufferRenderer> softwareRenderer(raster::DrawList list) {
  return std::make_unique<raster::SoftwareRenderer>(std::move(list));
}

std::unique_ptr<raster::ItemBufferRenderer> sceneRenderer(const Scene& scene, const Discretization& discretization,
                                                          const IdLayout& layout, ElementsBy elementsBy,
                                                          const RendererFactory& makeRenderer) {
  if (elementsBy == ElementsBy::Texture) return makeRenderer(makeDrawList(scene, discretization, layout));
  MeshedDraws mesh = makeMeshedDraws(scene, discretization, layout);
  return std::make_unique<MeshedRenderer>(makeRenderer(std::move(mesh.list)), std::move(mesh.firstPiece));
}

SceneFormFactors::SceneFormFactors(const Scene& scene, Discretization unsplit, IdLayout layout,
                                   const DrawingSettings& settings, const RendererFactory& makeRenderer)
    : scene_(scene),
      directions_(std::max(8 * settings.resolution, minDirections)),
      layout_(std::move(layout)),
      discretization_(std::move(unsplit)),
      renderer_(sceneRenderer(scene, discretization_, layout_, settings.elementsBy, makeRenderer)),
      rows_(scene, discretization_, layout_, *renderer_,
            {settings.resolution, settings.orientation, settings.projection, settings.pixelsPerElement}) {
  if (settings.split >= 1) return;
  if (settings.elementsBy == ElementsBy::Mesh)
    textures_ = softwareRenderer(makeDrawList(scene, discretization_, layout_));
  splitter_.emplace(scene, discretization_, layout_, textures_ ? *textures_ : *renderer_, settings.split);
}

void SceneFormFactors::splitAll() {
  const auto count = static_cast<std::uint32_t>(discretization_.patches.size());
  for (std::uint32_t patch = 0; splitter_ && patch < count; ++patch) splitter_->split(patch, 1);
}

OutsideFlux SceneFormFactors::outsideFlux() {
  // All views together draw at most about this number of triangles.
  constexpr std::size_t maxDrawn = std::size_t{1} << 28;
  const int affordable = std::max(static_cast<int>(maxDrawn / triangleCount(scene_)), minDirections);
  return radiosity::outsideFlux(scene_, discretization_, layout_, *renderer_, std::min(directions_, affordable));
}

PatchSplit SceneFormFactors::splits() {
  if (!splitter_) return {};
  return [this](std::uint32_t patch, double weight) { return splitter_->split(patch, weight); };
}

std::vector<ViewPoint> SceneFormFactors::likelyPoints(std::uint32_t number, double weight) {
  Patch patch = discretization_.patches[number];
  if (splitter_ && splitter_->wouldSplit(number, weight)) return {};
  if (splitter_ && !patch.isSettled) patch.halvings = halvingsFor(weight);
  return rows_.pointsOfPatch(number, patch);
}

}  // namespace hemitex::radiosity
