// The file solution.json of a solved folder, and its textures.
#include "cli/render/solved_folder.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/images/image.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

namespace {

/// Discretizations of more texels take too long.
constexpr long maxTexels = 1000;

struct SolutionFile : fuzz::InputFile {
  SolutionFile() : InputFile("solution.json") {
    radiosity::writeExr(folder() / "a.exr", {4, 4, std::vector<glm::dvec3>(16, glm::dvec3(1))});
  }
};

/// The faces of a scene file, one polygon per triangle.
radiosity::Scene facesOfFile() {
  radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  std::uint32_t face = 0;
  for (radiosity::Surface& surface : scene.surfaces)
    for (radiosity::Triangle& triangle : surface.triangles) triangle.polygon = face++;
  return scene;
}

bool isSmall(const radiosity::DiscretizationSettings& settings) {
  if (settings.texelSize || settings.texels.value_or(1) > 8) return false;
  long texels = 0;
  for (const auto& [name, grid] : settings.surfaceTexels) {
    if (grid.columns > maxTexels || grid.rows > maxTexels) return false;
    texels += long{grid.columns} * grid.rows;
  }
  return texels <= maxTexels;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const SolutionFile file;
  static const radiosity::Scene faces = facesOfFile();
  file.write(data, size);
  return fuzz::ignoringInputErrors([&] {
    radiosity::Scene scene = faces;
    const auto solved = cli::SolvedFolder::around(file.folder() / "scene.obj", scene);
    if (!solved) return;
    const radiosity::DiscretizationSettings grids = solved->grids(scene);
    if (isSmall(grids)) solved->radiosity(radiosity::discretize(scene, grids));
  });
}
