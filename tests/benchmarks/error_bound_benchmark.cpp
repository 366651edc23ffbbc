/// What a bound on the error costs: for every scene and bound, what `solve --max-error` takes, the choice included,
/// beside the cheapest of a grid of settings that keep the bound, and the true error of both. Prints a table; times are
/// of one thread, in seconds of the processor.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/patch_splitting.h"
#include "radiosity/projected_rows.h"
#include "radiosity/solver.h"
#include "radiosity/word_layout.h"
#include "raster/parallel.h"
#include "raster/software_renderer.h"
#include "reference/error_bound.h"
#include "reference/radiosity_error.h"
#include "reference/true_radiosity.h"

using namespace hemitex;

namespace {

constexpr int texels = 16;
constexpr int samples = 1 << 14;  // of the truth: 0.25 % are left to chance

struct Solved {
  std::vector<glm::dvec3> radiosity;  ///< one an element of the finest index maps
  double seconds;
};

/// Solves a scene, all steps from the discretization on.
class World {
 public:
  explicit World(const std::string& name)
      : scene_(radiosity::loadScene(HEMITEX_DATA "/" + name + ".obj")),
        finest_(radiosity::discretize(scene_, {.texels = texels})),
        truth_(reference::trueRadiosity(scene_, finest_, {.samples = samples}).radiosity) {}

  Solved solve(const reference::Effort& effort, const std::map<std::string, int>& surfaceTexels,
               double residual) const {
    const std::clock_t start = std::clock();
    radiosity::Discretization discretization =
        radiosity::discretize(scene_, {.texels = texels, .surfaceTexels = surfaceTexels, .patches = effort.patches});
    const radiosity::WordLayout layout = radiosity::layOut(discretization);
    raster::SoftwareRenderer renderer(radiosity::makeDrawList(scene_, discretization, layout));
    discretization = radiosity::splitPatches(scene_, std::move(discretization), layout, renderer, effort.split);
    radiosity::ProjectedRows rows(scene_, discretization, layout, renderer,
                                  {effort.resolution, radiosity::Orientation::Turned});
    const radiosity::Solution solution = radiosity::solve(
        scene_, discretization, [&rows](std::uint32_t patch) { return rows.ofPatch(patch); }, {.residual = residual});
    const double time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return {reference::onOtherGrids(discretization, solution.radiosity, finest_), time};
  }

  double errorOf(const Solved& solved) const {
    return reference::errorOf(finest_, solved.radiosity, truth_).fluxWeighted;
  }

  reference::ErrorBoundChoice choose(double bound, double& seconds) const {
    const auto solveWith = [&](const reference::Effort& effort) {
      Solved solved = solve(effort, {}, reference::residualFor(bound));
      seconds += solved.seconds;
      return std::move(solved.radiosity);
    };
    return reference::chooseEffort(scene_, finest_, texels, solveWith, bound);
  }

 private:
  radiosity::Scene scene_;
  radiosity::Discretization finest_;
  std::vector<glm::dvec3> truth_;
};

std::string text(const reference::Effort& effort) {
  char line[64];
  std::snprintf(line, sizeof line, "%d patches, split %.4f, R = %d", effort.patches, effort.split, effort.resolution);
  return line;
}

void compare(const World& world, const std::string& name, double bound) {
  double seconds = 0;
  const reference::ErrorBoundChoice choice = world.choose(bound, seconds);
  const Solved chosen = world.solve(choice.effort, choice.surfaceTexels, reference::residualFor(bound));
  seconds += chosen.seconds;
  Solved cheapest{{}, 1e30};
  reference::Effort best;
  for (const int patches : {2, 4})
    for (const double split : {0.1, 0.05, 0.03, 0.025, 0.0175, 0.0125})
      for (const int resolution : {48, 64, 80, 96, 112, 128, 144, 160, 192}) {
        Solved solved = world.solve({patches, split, resolution}, {}, reference::residualFor(bound));
        if (solved.seconds > cheapest.seconds || world.errorOf(solved) > bound) continue;
        best = {patches, split, resolution};
        cheapest = std::move(solved);
      }
  std::printf("%-12s %5.3f | %-40s %.4f expected, %.4f true, %6.3f s | %-40s %.4f true, %6.3f s | %.2f\n", name.c_str(),
              bound, text(choice.effort).c_str(), choice.expectedError, world.errorOf(chosen), seconds,
              text(best).c_str(), world.errorOf(cheapest), cheapest.seconds, seconds / cheapest.seconds);
  std::fflush(stdout);
}

}  // namespace

/// The scenes of data/ whose names are given, or all.
int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"cornell-box", "curved-room", "paper-room", "pyramid-room"};
  for (const std::string& name : names) {
    const World world(name);
    const raster::ThreadLimit one(1);
    for (const double bound : {0.03, 0.01}) compare(world, name, bound);
  }
}
