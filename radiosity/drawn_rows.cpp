#include "radiosity/drawn_rows.h"

#include <utility>

#include "raster/software_renderer.h"

namespace hemitex::radiosity {

std::unique_ptr<raster::ItemBufferRenderer> softwareRenderer(raster::DrawList list) {
  return std::make_unique<raster::SoftwareRenderer>(std::move(list));
}

DrawnRows::DrawnRows(const Scene& scene, Discretization unsplit, WordLayout layout, const DrawingSettings& settings,
                     const RendererFactory& makeRenderer)
    : layout_(std::move(layout)),
      renderer_(makeRenderer(makeDrawList(scene, unsplit, layout_))),
      discretization_(splitPatches(scene, std::move(unsplit), layout_, *renderer_, settings.split)),
      rows_(scene, discretization_, layout_, *renderer_, {settings.resolution, settings.orientation}) {}

}  // namespace hemitex::radiosity
