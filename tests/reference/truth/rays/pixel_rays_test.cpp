// PixelRays meet the triangles that the rasterizer shows.
#include "reference/truth/rays/pixel_rays.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/projection_kinds.h"
#include "radiosity/scene/load_scene.h"
#include "raster/software/software_renderer.h"

using namespace hemitex;
using namespace hemitex::reference;

namespace {

/// Each triangle with its number as item ID, for both facings.
raster::DrawList numbered(raster::DrawList list) {
  list.format = *raster::formatNamed("r32ui");
  list.indexMaps.clear();
  list.draws.clear();
  for (std::uint32_t t = 0; 3 * t < list.indices.size(); ++t) list.draws.push_back({3 * t, 3, t, {}, {}});
  return list;
}

}  // namespace

TEST_CASE("PixelRays meet the triangles that SoftwareRenderer shows", "[pixel_rays]") {
  // Rays pass through the samples. Results differ only where snapping to 1/256 pixel moves an edge over a sample. Edges
  // pass through a few percent of pixels, and a few percent of those are that close.
  const radiosity::Scene scene = radiosity::loadScene(HEMITEX_DATA "/cornell-box.obj");
  const radiosity::Discretization discretization = radiosity::discretize(scene, {.texels = 1});
  const raster::DrawList list =
      numbered(radiosity::makeDrawList(scene, discretization, radiosity::layOut(discretization)));
  const glm::dvec3 eye = glm::dvec3(0.05, -0.3, 0.1) * scene.extent;
  const PixelRays rays(list);
  raster::SoftwareRenderer renderer(list);
  std::vector<raster::ItemBuffer> met;
  for (const int resolution : {100, 26, 64}) {  // packets of 4 x 4 divide only the last
    const std::vector<raster::Face> faces =
        radiosity::facesOver(radiosity::hemicubeFaces(resolution), eye, {0, 1, 0}, {0, 0, 1}, 1e-4 * scene.extent);
    const std::vector<raster::ItemBuffer> drawn = render(renderer, faces, {});
    rays.cast(faces, met);
    REQUIRE(met.size() == drawn.size());
    std::size_t differing = 0, all = 0, hit = 0;
    for (std::size_t f = 0; f < met.size(); ++f) {
      REQUIRE(met[f].width == drawn[f].width);
      REQUIRE(met[f].ids.size() == drawn[f].ids.size());
      for (std::size_t i = 0; i < met[f].ids.size(); ++i, ++all) {
        differing += met[f].ids[i] != drawn[f].ids[i] ? 1 : 0;
        hit += met[f].ids[i] != noTriangle ? 1 : 0;
      }
    }
    INFO("R = " << resolution << ": " << differing << " of " << all);
    CHECK(hit > all / 2);
    CHECK(differing <= all / 500);
  }
}
