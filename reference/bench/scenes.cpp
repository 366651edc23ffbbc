#include "reference/bench/scenes.h"

#include <utility>

#include "radiosity/discretization/grid_size.h"
#include "radiosity/scene/load_scene.h"

namespace hemitex::reference {
namespace {

/// 3841 elements (see reference/paper/scenes.h).
void asFineRoom(BenchScene& room) {
  room.elements = {.texels = 24, .surfaceTexels = {{"light", 1}}, .patch = 8};
  for (const char* face : {"bottom", "top", "front", "right", "back", "left"})
    room.elements.surfaceTexels[std::string("box-") + face] = 8;
}

/// In eight packed pages of 256 x 256 texels.
void asFineGallery(BenchScene& gallery) {
  constexpr int pages = 8, coarseSide = 64, subdivision = 4;
  gallery.elements = radiosity::settingsForPages(gallery.scene, pages, coarseSide);
  gallery.elements.subdivision = subdivision;
  gallery.elements.patch = 16;
  gallery.ids.indexMaps = radiosity::IndexMaps::Packed;
  gallery.ids.page = coarseSide * subdivision;
}

}  // namespace

BenchScene benchScene(const std::filesystem::path& file) {
  BenchScene scene{file.stem().string(), radiosity::loadScene(file), {}, {.format = "r32ui"}};
  radiosity::requireEmission(scene.scene, file);
  return scene;
}

std::vector<BenchScene> benchScenes(const std::filesystem::path& folder) {
  std::vector<BenchScene> scenes;
  for (const char* file : {"paper-room.obj", "cornell-box.obj", "gallery.obj"})
    scenes.push_back(benchScene(folder / file));
  asFineRoom(scenes.front());
  asFineGallery(scenes.back());
  return scenes;
}

}  // namespace hemitex::reference
