// Cameras in the file SCENE.view.json.
#include "cli/scene/camera_options.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("scene.view.json");
  static const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  file.write(data, size);
  return fuzz::ignoringInputErrors([&] { cli::cameraOf({}, scene, file.folder() / "scene.obj"); });
}
