#include "reference/paper/scenes.h"

#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/grid_size.h"
#include "radiosity/scene/load_scene.h"

namespace hemitex::reference {
namespace {

void addLevel(PaperScene& scene, const std::string& name, const radiosity::DiscretizationSettings& settings,
              const radiosity::IdSettings& ids = {}) {
  radiosity::Discretization discretization = radiosity::discretize(scene.scene, settings);
  radiosity::IdLayout layout = radiosity::layOut(discretization, ids);
  scene.levels.push_back({name, std::move(discretization), std::move(layout)});
}

/// Elements along a wall's side, along the side of a face of the box, and along a patch's.
struct RoomLevel {
  int wall = 0, boxFace = 0, patch = 0;
};

radiosity::DiscretizationSettings settingsOf(const RoomLevel& level) {
  radiosity::DiscretizationSettings settings{
      .texels = level.wall, .surfaceTexels = {{"light", 1}}, .patch = level.patch};
  for (const char* face : {"bottom", "top", "front", "right", "back", "left"})
    settings.surfaceTexels[std::string("box-") + face] = level.boxFace;
  return settings;
}

PaperScene sceneOf(const std::filesystem::path& folder, const std::string& file, const std::string& name) {
  return {.name = name, .scene = radiosity::loadScene(folder / file), .levels = {}};
}

/// Texels as small as eight packed pages of 64 x 64 allow, halved twice.
PaperScene complexOf(const std::filesystem::path& folder) {
  constexpr int pages = 8, side = 64, patch = 4;
  PaperScene complex = sceneOf(folder, "gallery.obj", "complex");
  radiosity::DiscretizationSettings settings = radiosity::settingsForPages(complex.scene, pages, side);
  for (const char* level : {"coarse", "medium", "fine"}) {
    settings.patch = patch * settings.subdivision;
    addLevel(complex, level, settings,
             {.indexMaps = radiosity::IndexMaps::Packed, .page = side * settings.subdivision});
    settings.subdivision *= 2;
  }
  return complex;
}

}  // namespace

std::vector<PaperScene> paperScenes(const std::filesystem::path& folder) {
  PaperScene simple = sceneOf(folder, "paper-room.obj", "simple");
  addLevel(simple, "coarse", settingsOf({6, 2, 2}));
  addLevel(simple, "medium", settingsOf({12, 4, 4}));
  addLevel(simple, "fine", settingsOf({24, 8, 8}));
  PaperScene plant = sceneOf(folder, "plant.obj", "plant");
  addLevel(plant, "coarse", {.texelSize = 0.25, .patch = 4});
  PaperScene fillLimited = sceneOf(folder, "paper-room.obj", "fill-limited");
  addLevel(fillLimited, "coarse", settingsOf({2, 1, 2}));
  return {simple, complexOf(folder), plant, fillLimited};
}

}  // namespace hemitex::reference
