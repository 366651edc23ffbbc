// Files of `--lights`, and the changes of a scene that they name.
#include <CLI/CLI.hpp>

#include "cli/scene/material_options.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("lights.json");
  static const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] {
    CLI::App app;
    cli::MaterialOptions options;
    cli::PathOptions paths;
    cli::addMaterialOptions(cli::Command(app, paths), options);
    app.parse("--lights " + path.string());
    cli::withMaterials(scene, options, {});
  });
}
