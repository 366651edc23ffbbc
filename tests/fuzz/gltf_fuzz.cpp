// glTF files, text or binary, until they are a scene with materials and images.
#include "radiosity/scene/load_scene.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("scene.glb");
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] { radiosity::loadScene(path); });
}
