#include "reference/paper_scenes.h"

#include <utility>

namespace hemitex::reference {
namespace {

void addLevel(PaperScene& scene, const std::string& name, const radiosity::DiscretizationSettings& settings,
              const radiosity::WordSettings& words = {}) {
  radiosity::Discretization discretization = radiosity::discretize(scene.scene, settings);
  radiosity::WordLayout layout = radiosity::layOut(discretization, words);
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

PaperScene room(const std::filesystem::path& folder, const std::string& name) {
  return {.name = name, .scene = radiosity::loadScene(folder / "paper-room.obj"), .levels = {}};
}

}  // namespace

std::vector<PaperScene> paperScenes(const std::filesystem::path& folder) {
  PaperScene simple = room(folder, "simple");
  addLevel(simple, "coarse", settingsOf({6, 2, 2}));
  addLevel(simple, "medium", settingsOf({12, 4, 4}));
  addLevel(simple, "fine", settingsOf({24, 8, 8}));
  PaperScene fillLimited = room(folder, "fill-limited");
  addLevel(fillLimited, "coarse", settingsOf({2, 1, 2}));
  return {simple, fillLimited};
}

}  // namespace hemitex::reference
