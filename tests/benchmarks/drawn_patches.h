/// The scenes of `hemitex bench` for benchmarks, and hemicubes over some of their patches.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/item_buffer_sum.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/software/software_renderer.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/scenes.h"

namespace hemitex::tests {

/// A scene of benchScenes.
inline const reference::BenchScene& sceneNamed(const std::string& name) {
  static const std::vector<reference::BenchScene> scenes = reference::benchScenes(HEMITEX_DATA);
  return *std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return scene.name == name; });
}

/// Patches of a scene, spread evenly, with their views and item buffers. The scene must outlive this object.
struct DrawnPatches {
  radiosity::Discretization discretization;
  radiosity::IdLayout layout;
  raster::SoftwareRenderer renderer;
  radiosity::ProjectedFormFactors rows;
  std::vector<radiosity::Patch> patches;
  std::vector<radiosity::View> views;
  std::vector<std::vector<raster::ItemBuffer>> drawn;
  radiosity::ItemBufferSum sum;

  DrawnPatches(const radiosity::Scene& scene, const radiosity::DiscretizationSettings& elements,
               const radiosity::IdSettings& ids, int resolution, std::size_t count)
      : discretization(radiosity::discretize(scene, elements)),
        layout(radiosity::layOut(discretization, ids)),
        renderer(radiosity::makeDrawList(scene, discretization, layout)),
        rows(scene, discretization, layout, renderer, {.resolution = resolution}),
        patches(reference::spreadPatches(discretization, count)),
        sum(discretization, layout) {
    for (const radiosity::Patch& patch : patches) {
      views.push_back(rows.viewsOfPatch(patch).front());
      raster::draw(renderer, views.back().faces, views.back().skipped, drawn.emplace_back());
    }
  }

  radiosity::FormFactorRow sumOf(std::size_t patch) {
    return sum.rowOf(rows.projection(), radiosity::wholeFaces(rows.projection()), drawn[patch]);
  }
};

}  // namespace hemitex::tests
