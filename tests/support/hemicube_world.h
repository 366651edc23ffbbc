/// A discretized scene with all objects that drawing hemicubes needs.
#pragma once

#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/software/software_renderer.h"

namespace hemitex::tests {

struct HemicubeWorld {
  radiosity::Scene scene;
  radiosity::Discretization discretization;
  radiosity::IdLayout layout;
  raster::SoftwareRenderer renderer;

  HemicubeWorld(radiosity::Scene s, int texels, int patch)
      : HemicubeWorld(std::move(s), radiosity::DiscretizationSettings{.texels = texels, .patch = patch}) {}

  HemicubeWorld(radiosity::Scene s, const radiosity::DiscretizationSettings& settings)
      : scene(std::move(s)),
        discretization(radiosity::discretize(scene, settings)),
        layout(radiosity::layOut(discretization)),
        renderer(radiosity::makeDrawList(scene, discretization, layout)) {}

  radiosity::ProjectedFormFactors rows(int resolution) {
    return {scene, discretization, layout, renderer, {.resolution = resolution}};
  }
};

}  // namespace hemitex::tests
