// Files of edits, and the edits themselves.
#include "cli/solve/edits_file.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("edits.json");
  static const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] { cli::readEdits(path, scene, {}); });
}
