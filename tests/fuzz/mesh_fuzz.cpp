// Files of meshes, until they are a scene. The first byte says which format the others are in, and the settings.
#include <array>

#include "radiosity/scene/load_scene.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::array<fuzz::InputFile, 5> files{fuzz::InputFile("a.stl"), fuzz::InputFile("a.ply"),
                                                    fuzz::InputFile("a.vtk"), fuzz::InputFile("a.vtu"),
                                                    fuzz::InputFile("a.vs3")};
  static const std::array<radiosity::SceneSettings, 4> settings{
      radiosity::SceneSettings{},
      {.cellReflectance = "r", .cellEmission = "e"},
      {.facets = true, .cellEmission = "e"},
      {.charts = radiosity::Charts::Planar, .sides = radiosity::Sides::TwoOfSheets},
  };
  if (size == 0) return 0;
  const std::filesystem::path& path = files[data[0] % files.size()].write(data + 1, size - 1);
  return fuzz::ignoringInputErrors(
      [&] { radiosity::loadScene(path, settings[data[0] / files.size() % settings.size()]); });
}
