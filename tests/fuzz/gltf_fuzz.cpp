// glTF files, text or binary, without decoding their images.
#include "radiosity/scene/gltf_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("scene.glb");
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] { radiosity::readGltf(path); });
}
