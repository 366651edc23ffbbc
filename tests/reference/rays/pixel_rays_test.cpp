// Rays through pixels: the triangles that the rasterizer shows there.
#include "reference/rays/pixel_rays.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/hemicube.h"
#include "radiosity/scene/load_scene.h"
#include "raster/software/software_renderer.h"

using namespace hemitex;
using namespace hemitex::reference;

namespace {

/// Every triangle with its own number as its item ID, whichever way it faces.
raster::DrawList numbered(raster::DrawList list) {
  list.format = *raster::formatNamed("r32ui");
  list.indexMaps.clear();
  list.draws.clear();
  for (std::uint32_t t = 0; 3 * t < list.indices.size(); ++t) list.draws.push_back({3 * t, 3, t, {}, {}});
  return list;
}

}  // namespace

TEST_CASE("rays through pixels meet the triangles that the rasterizer shows", "[pixel_rays]") {
  // Rays start and go where samples are; they differ where snapping to 1/256 pixel moves an edge over a sample. Edges
  // run through a few of a hundred pixels, and of those few in a hundred are so close.
  const radiosity::Scene scene = radiosity::loadScene(HEMITEX_DATA "/cornell-box.obj");
  const radiosity::Discretization discretization = radiosity::discretize(scene, {.texels = 1});
  const raster::DrawList list =
      numbered(radiosity::makeDrawList(scene, discretization, radiosity::layOut(discretization)));
  const glm::dvec3 eye = glm::dvec3(0.05, -0.3, 0.1) * scene.extent;
  const PixelRays rays(list);
  raster::SoftwareRenderer renderer(list);
  std::vector<raster::ItemBuffer> met;
  for (const int resolution : {100, 26, 64}) {  // packets of 4 x 4 fit the last alone
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
