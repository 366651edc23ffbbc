// Files of `--bands`.
#include "cli/solve/bands_file.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("bands");
  static const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] { cli::readBands(path, scene, {}); });
}
