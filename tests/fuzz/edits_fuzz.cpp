// Files of edits, and solutions of the edited scenes.
#include "cli/solve/edits_file.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/solver/dynamic_solution.h"
#include "raster/base/file_io.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

namespace {

/// Beside a scene that edits can add.
struct EditsFile : fuzz::InputFile {
  EditsFile() : InputFile("edits.json") {
    raster::writeFile(folder() / "chair.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
};

radiosity::IdLayout layOutIds(const radiosity::Discretization& discretization) {
  return radiosity::layOut(discretization);
}

/// The solution of a scene at a low resolution, ready for edits.
radiosity::DynamicSolution solved(const radiosity::Scene& scene) {
  const radiosity::DynamicSettings settings{
      {.texels = 1, .isUnburied = true, .patch = 1}, {.resolution = 4}, {.shots = 1}};
  radiosity::Discretization discretization = radiosity::discretize(scene, settings.discretization);
  radiosity::SceneFormFactors drawn(scene, discretization, layOutIds(discretization), settings.drawing);
  radiosity::Solution solution = radiosity::solve({.scene = scene,
                                                   .discretization = discretization,
                                                   .patches = discretization.patches,
                                                   .rowOf = drawn.rowOf(),
                                                   .settings = settings.solver,
                                                   .isContinued = true});
  discretization.patches = solution.patches;
  return {scene, std::move(discretization), std::move(solution), settings, layOutIds};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const EditsFile file;
  static const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] {
    const std::vector<cli::Frame> frames = cli::readEdits(path, scene, {});
    radiosity::DynamicSolution solution = solved(scene);
    for (const cli::Frame& frame : frames) solution.update(frame.edits);
  });
}
