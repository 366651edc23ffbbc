// BenchFloor computes the same rows as hemicubes.
#include "reference/measurement/bench/baseline.h"

#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "raster/software/software_renderer.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

TEST_CASE("BenchFloor::row of drawn item IDs is the row of their hemicube, after any other row", "[bench]") {
  const Scene scene = loadScene(HEMITEX_DATA "/cornell-box.obj");
  const Discretization discretization = discretize(scene, {.texels = 9});
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 70});
  reference::BenchFloor floor(discretization, layout, rows.projection());
  for (const std::uint32_t patch : {0U, 20U, 5U, 5U}) {
    const View view = rows.viewsOfPatch(patch).front();
    const FormFactorRow expected = rows.ofView(view), found = floor.row(render(renderer, view.faces, view.skipped));
    CHECK(found.elements == expected.elements);
    CHECK(found.shares == expected.shares);
    CHECK(found.background == expected.background);
    CHECK(found.back == expected.back);
  }
}
