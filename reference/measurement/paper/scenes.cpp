#include "reference/measurement/paper/scenes.h"

#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "reference/measurement/bench/scenes.h"

namespace hemitex::reference {
namespace {

void addLevel(PaperScene& scene, const std::string& name, const radiosity::DiscretizationSettings& settings,
              const radiosity::IdSettings& ids = {}) {
  radiosity::Discretization discretization = radiosity::discretize(scene.scene, settings);
  radiosity::IdLayout layout = radiosity::layOut(discretization, ids);
  scene.levels.push_back({name, std::move(discretization), std::move(layout)});
}

}  // namespace

std::vector<PaperScene> paperScenes(const std::filesystem::path& folder) {
  const auto sceneOf = [&folder](const std::string& file, const std::string& name) -> PaperScene {
    return {.name = name, .scene = radiosity::loadScene(folder / file), .levels = {}};
  };
  PaperScene simple = sceneOf("paper-room.obj", "simple");
  addLevel(simple, "coarse", roomElements(6, 2, 2));
  addLevel(simple, "medium", roomElements(12, 4, 4));
  addLevel(simple, "fine", roomElements(24, 8, 8));
  PaperScene complex = sceneOf("gallery.obj", "complex");
  for (const auto& [level, subdivision] : {std::pair{"coarse", 1}, {"medium", 2}, {"fine", 4}}) {
    const BenchScene packed = packedScene(level, complex.scene, subdivision);
    addLevel(complex, level, packed.elements, packed.ids);
  }
  PaperScene plant = sceneOf("plant.obj", "plant");
  addLevel(plant, "coarse", {.texelSize = 0.25, .patch = 4});
  PaperScene fillLimited = sceneOf("paper-room.obj", "fill-limited");
  addLevel(fillLimited, "coarse", roomElements(2, 1, 2));
  return {simple, complex, plant, fillLimited};
}

}  // namespace hemitex::reference
