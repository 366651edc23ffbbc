#include "radiosity/drawn_rows.h"

#include <utility>

#include "radiosity/meshed_draws.h"
#include "radiosity/meshed_renderer.h"
#include "raster/software_renderer.h"

namespace hemitex::radiosity {
namespace {

Discretization splitByTextures(const Scene& scene, Discretization unsplit, const WordLayout& layout,
                               raster::ItemBufferRenderer& renderer, const DrawingSettings& settings) {
  if (settings.elementsBy == ElementsBy::Texture)
    return splitPatches(scene, std::move(unsplit), layout, renderer, settings.split);
  raster::SoftwareRenderer textures(makeDrawList(scene, unsplit, layout));
  return splitPatches(scene, std::move(unsplit), layout, textures, settings.split);
}

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> softwareRenderer(raster::DrawList list) {
  return std::make_unique<raster::SoftwareRenderer>(std::move(list));
}

std::unique_ptr<raster::ItemBufferRenderer> sceneRenderer(const Scene& scene, const Discretization& discretization,
                                                          const WordLayout& layout, ElementsBy elementsBy,
                                                          const RendererFactory& makeRenderer) {
  if (elementsBy == ElementsBy::Texture) return makeRenderer(makeDrawList(scene, discretization, layout));
  MeshedDraws mesh = makeMeshedDraws(scene, discretization, layout);
  return std::make_unique<MeshedRenderer>(makeRenderer(std::move(mesh.list)), std::move(mesh.firstPiece));
}

DrawnRows::DrawnRows(const Scene& scene, Discretization unsplit, WordLayout layout, const DrawingSettings& settings,
                     const RendererFactory& makeRenderer)
    : layout_(std::move(layout)),
      renderer_(sceneRenderer(scene, unsplit, layout_, settings.elementsBy, makeRenderer)),
      discretization_(splitByTextures(scene, std::move(unsplit), layout_, *renderer_, settings)),
      rows_(scene, discretization_, layout_, *renderer_,
            {settings.resolution, settings.orientation, settings.projection, settings.pixelsPerElement}) {}

}  // namespace hemitex::radiosity
