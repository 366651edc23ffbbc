// MTL files.
#include "radiosity/scene/mtl_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::ignoringInputErrors([&] { radiosity::parseMaterials(fuzz::textOf(data, size), "scene.mtl"); });
}
