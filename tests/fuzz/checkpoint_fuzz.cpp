// What checkpoints hold behind their hash, which is made here, and solutions that go on from it: all light is finite.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cli/solve/checkpoint.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "reference/base/hashes/sha256.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

namespace {

const cli::CheckpointOwner owner{"1", "scene", "settings"};

/// The line with which checkpoints begin.
std::string title() {
  const std::string empty = cli::checkpointBytes(owner, {});
  return empty.substr(0, empty.find('\n') + 1);
}

/// A cube that is drawn at a low resolution.
struct Room {
  const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const radiosity::Discretization discretization = radiosity::discretize(scene, {.texels = 2, .patch = 2});
  radiosity::SceneFormFactors drawn{
      scene, discretization, radiosity::layOut(discretization), {.resolution = 8, .split = 0.1}};

  void goOnFrom(const radiosity::Snapshot& snapshot) {
    const radiosity::Solution solution = radiosity::solve({.scene = scene,
                                                           .discretization = discretization,
                                                           .patches = discretization.patches,
                                                           .rowOf = drawn.rowOf(),
                                                           .split = drawn.splits(),
                                                           .settings = {.shots = 10},
                                                           .snapshot = &snapshot});
    const auto isFinite = [](const glm::dvec3& v) {
      return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b);
    };
    if (!std::all_of(solution.radiosity.begin(), solution.radiosity.end(), isFinite))
      throw std::logic_error("light is not finite");
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Room room;
  const std::string content = fuzz::textOf(data, size);
  return fuzz::ignoringInputErrors([&] {
    for (const std::string& bytes : cli::readCheckpoint(title() + reference::sha256(content) + content, owner)) {
      std::string_view rest = bytes;
      room.goOnFrom(radiosity::takeSnapshot(rest));
    }
  });
}
