#include "tests/accuracy/limit_cases.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/input_error.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"
#include "tests/support/temporary_folder.h"

namespace hemitex::accuracy {
namespace {

using namespace radiosity;

/// A scene of one square, as files.
struct Files {
  std::string obj = "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl paint\nf 1 2 3 4\n";
  std::string mtl = "newmtl paint\nKd 0.5\nKe 1\n";
};

/// The message of loading a scene up to its draw list: that of its error, or its last warning.
std::string saidOf(const Files& files, const DiscretizationSettings& settings, const std::string& format) {
  const TemporaryFolder folder;
  const std::filesystem::path scenePath = folder.path / "scene.obj";
  std::ofstream(scenePath) << files.obj;
  std::ofstream(folder.path / "scene.mtl") << files.mtl;
  try {
    const Scene scene = loadScene(scenePath);
    requireEmission(scene, scenePath);
    layOut(discretize(scene, settings), {format, raster::Blend::ClampedAdd, true});
    return scene.warnings.empty() ? "" : scene.warnings.back();
  } catch (const raster::InputError& error) {
    std::string message = error.what();
    const std::string path = folder.path.string() + "/";
    if (const auto at = message.find(path); at != std::string::npos) message.erase(at, path.size());
    return message;
  }
}

LimitCase error(const std::string& name, const std::string& limit, const Files& files,
                const DiscretizationSettings& settings = {}, const std::string& format = "r8g8b8a8") {
  return {name, limit, true, saidOf(files, settings, format)};
}

LimitCase warning(const std::string& name, const std::string& limit, const Files& files) {
  return {name, limit, false, saidOf(files, {}, "r8g8b8a8")};
}

/// A sheet between a lit floor and a ceiling, as two coincident faces. The floor sees the first in the file, which is
/// the one that faces away.
std::string saidOfCoincidentFaces() {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  scene.materials.push_back(tests::material("light", glm::dvec3(0.5), glm::dvec3(1)));
  scene.surfaces[2].material = 1;
  const glm::dvec3 corner(0.1, 0.5, 0.1), x(0.8, 0, 0), z(0, 0, 0.8);
  scene.surfaces.push_back(tests::parallelogram("up", corner, z, x));
  scene.surfaces.push_back(tests::parallelogram("down", corner, x, z));
  tests::HemicubeWorld world(tests::finish(std::move(scene)), 2, 1);
  ProjectedFormFactors rows = world.rows(64);
  const Solution solution = solve({.scene = world.scene,
                                   .discretization = world.discretization,
                                   .patches = world.discretization.patches,
                                   .rowOf = [&](const radiosity::Patch& patch) { return rows.ofPatch(patch); }});
  return solution.warnings.empty() ? "" : solution.warnings.back().text;
}

Files withVertex(const std::string& numbers) {
  Files files;
  files.obj.replace(files.obj.find("v 1 1 0"), 7, "v " + numbers);
  return files;
}

Files withMaterial(const std::string& statements) { return {.mtl = "newmtl paint\n" + statements}; }

/// Enough squares of 16 x 16 texels each to need more than 16 bits.
Files manySquares() {
  Files files;
  for (int i = 1; i <= 256; ++i) {
    const std::string z = std::to_string(i);
    files.obj +=
        "g square" + z + "\nv 0 0 " + z + "\nv 1 0 " + z + "\nv 1 1 " + z + "\nv 0 1 " + z + "\nf -4 -3 -2 -1\n";
  }
  return files;
}

}  // namespace

std::vector<LimitCase> limitCases() {
  return {
      error("a coordinate of 2e18", "1e18", withVertex("2e18 1 0")),
      error("a scene of 1e-19", "1e-18",
            {.obj = "mtllib scene.mtl\nv 0 0 0\nv 1e-19 0 0\nv 0 1e-19 0\nusemtl paint\nf 1 2 3\n"}),
      error("a number that is none", "finite numbers", withVertex("nan 1 0")),
      warning("a face without area", "left out", {.obj = Files().obj + "f 1 1 2\n"}),
      warning("a reflectance of 1", "below 1", withMaterial("Kd 1\nKe 1\n")),
      error("a negative reflectance", "0", withMaterial("Kd -0.1\nKe 1\n")),
      error("an emission of 2e30", "1e30", withMaterial("Kd 0.5\nKe 2e30\n")),
      error("an emission of 1e-31", "1e-30", withMaterial("Kd 0.5\nKe 1e-31\n")),
      error("no emission at all", "something emits", withMaterial("Kd 0.5\nKe 0\n")),
      error("an index map of more than 24 bits", "4096 x 4096 texels", {}, {.texels = 5793}),
      error("257 surfaces of 16 x 16 texels in 16 bits", "65534 item IDs", manySquares(), {.texels = 16}, "r5g6b5"),
      {"faces back to back in one place, the wrong one first", "the first in the file is seen", false,
       saidOfCoincidentFaces()},
  };
}

}  // namespace hemitex::accuracy
