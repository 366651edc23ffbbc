/// A scene with the default elements, and their true radiosity by light tracing
/// (tests/truth/baked_radiosity.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "reference/measurement/tradeoff/methods.h"
#include "reference/truth/solution/radiosity_error.h"
#include "tests/truth/baked_radiosity.h"

namespace hemitex::tests {

struct TracedScene {
  radiosity::Scene scene;
  radiosity::Discretization discretization;
  std::vector<glm::dvec3> truth;  ///< radiosity of each element
  double truthError = 0;          ///< sum of the standard errors of all fluxes over the sum of all fluxes

  /// `paths`: see BakeSettings.
  TracedScene(const std::string& file, int paths)
      : scene(radiosity::loadScene(file)), discretization(radiosity::discretize(scene, {})) {
    const radiosity::Discretization unburied = radiosity::discretizeUnburied(scene, {});
    const tests::BakedRadiosity baked =
        tests::bakedRadiosity(scene, unburied, {.paths = paths, .points = 32, .seed = 0});
    truth.resize(discretization.elements.size());
    double flux = 0;
    for (std::size_t e = 0; e < unburied.elements.size(); ++e) {
      const radiosity::Element& element = unburied.elements[e];
      truth[discretization.grids[element.surface].elementOfTexel[element.texel]] += baked.flux[e];
      flux += radiosity::bandSum(baked.flux[e]);
      truthError += radiosity::bandSum(baked.fluxError[e]);
    }
    truthError /= flux;
    for (std::size_t e = 0; e < truth.size(); ++e) truth[e] /= discretization.elements[e].area;
  }

  /// The error of a solution as in docs/light.md, also called the error of the light.
  double errorOf(const std::vector<glm::dvec3>& found) const {
    return reference::errorOf(discretization, found, truth).fluxWeighted;
  }

  /// Radiosity by a method at a setting.
  std::vector<glm::dvec3> solvedBy(const reference::TradeMethod& method, int setting, double residual) const {
    const reference::TradeRows rows = method.rows(setting);
    const radiosity::LightSettings settings{.drawing = rows.drawing, .solver = {.residual = residual}};
    return radiosity::light(scene, discretization, settings, {.rows = rows.others}).solution.radiosity;
  }
};

}  // namespace hemitex::tests
