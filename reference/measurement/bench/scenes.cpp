#include "reference/measurement/bench/scenes.h"

#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/grid_size.h"
#include "radiosity/scene/load_scene.h"

namespace hemitex::reference {

radiosity::DiscretizationSettings roomElements(int wall, int boxFace, int patch) {
  radiosity::DiscretizationSettings elements{.texels = wall, .surfaceTexels = {{"light", 1}}, .patch = patch};
  for (const char* face : {"bottom", "top", "front", "right", "back", "left"})
    elements.surfaceTexels[std::string("box-") + face] = boxFace;
  return elements;
}

BenchScene packedScene(std::string name, radiosity::Scene scene, int subdivision) {
  constexpr int pages = 8, side = 64, patch = 4;
  radiosity::DiscretizationSettings elements = radiosity::settingsForPages(scene, pages, side);
  elements.subdivision = subdivision;
  elements.patch = patch * subdivision;
  return {std::move(name),
          std::move(scene),
          elements,
          {.indexMaps = radiosity::IndexMaps::Packed, .page = side * subdivision}};
}

BenchScene benchScene(const std::filesystem::path& file) {
  BenchScene scene{file.stem().string(), radiosity::loadScene(file), {}, {.format = "r32ui"}};
  radiosity::requireEmission(scene.scene, file);
  return scene;
}

std::vector<BenchScene> benchScenes(const std::filesystem::path& folder) {
  constexpr int fine = 4;
  BenchScene room = benchScene(folder / "paper-room.obj"), box = benchScene(folder / "cornell-box.obj");
  room.elements = roomElements(24, 8, 8);
  BenchScene gallery = packedScene("gallery", radiosity::loadScene(folder / "gallery.obj"), fine);
  gallery.ids.format = "r32ui";
  return {room, box, gallery};
}

}  // namespace hemitex::reference
