/// The cost of a bound on the error. For each scene and bound, compares `solve --max-error`, including the choice of
/// settings, with the cheapest setting of `tradeoff` that keeps the bound. An error is the larger one of the errors of
/// all surfaces and of those that the default camera sees. Prints the time and the true error of both. The reference is
/// light tracing. Prints one line per scene and bound, and how often bounds were kept; times are processor seconds.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/pictures/default_camera.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/solver/error_control.h"
#include "radiosity/solver/progressive_solver.h"
#include "reference/measurement/tradeoff/methods.h"
#include "reference/measurement/tradeoff/tradeoff.h"
#include "tests/benchmarks/traced_scene.h"

using namespace hemitex;
using tests::TracedScene;

namespace {

using Radiosity = std::vector<glm::dvec3>;

constexpr int paths = 1 << 24;

/// Processor seconds since its construction.
class ProcessorWatch {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

/// A scene with its true radiosity, and the surfaces that the default camera sees.
struct Judge {
  TracedScene world;
  std::vector<bool> seen;

  explicit Judge(const std::string& file)
      : world(file, paths),
        seen(radiosity::seenSurfaces(world.scene, radiosity::defaultCamera(world.scene), 256, 192)) {}

  double errorOf(const Radiosity& found) const {
    return radiosity::lightErrors(world.discretization, seen, found, world.truth).larger();
  }
};

struct Timed {
  Radiosity radiosity;
  double seconds = 0;
};

Timed solvedWithin(const Judge& judge, double bound) {
  const TracedScene& world = judge.world;
  const ProcessorWatch watch;
  Timed timed;
  const auto solveWith = [&](const radiosity::Effort& effort) {
    radiosity::SceneFormFactors drawn(world.scene, world.discretization, radiosity::layOut(world.discretization),
                                      {.resolution = effort.resolution, .split = effort.split});
    return timed.radiosity = radiosity::solve({.scene = world.scene,
                                               .discretization = world.discretization,
                                               .patches = world.discretization.patches,
                                               .rowOf = drawn.rowOf(),
                                               .split = drawn.splits(),
                                               .settings = {.residual = radiosity::residualFor(bound)},
                                               .seen = {judge.seen, drawn.scoutRows()}})
                                 .radiosity;
  };
  radiosity::chooseEffort(world.discretization, judge.seen, solveWith, bound);
  timed.seconds = watch.seconds();
  return timed;
}

Timed solvedBy(const TracedScene& world, const reference::TradeMethod& method, int setting) {
  const ProcessorWatch watch;
  Radiosity radiosity = world.solvedBy(method, setting, reference::tradeResidual);
  return {std::move(radiosity), watch.seconds()};
}

struct Setting {
  std::string name;
  double error = 0, seconds = 0;
};

/// Enough settings to find the cheapest one for a bound of at least `smallest`.
std::vector<Setting> measuredSettings(const Judge& judge, double smallest) {
  std::vector<Setting> settings;
  double cheapest = std::numeric_limits<double>::infinity();  // within the smallest bound
  for (const reference::TradeMethod& method : reference::tradeMethods())
    for (const int setting : method.measured) {
      const Timed timed = solvedBy(judge.world, method, setting);
      const double error = judge.errorOf(timed.radiosity);
      settings.push_back({method.name + " " + std::to_string(setting), error, timed.seconds});
      if (error <= smallest) cheapest = std::min(cheapest, timed.seconds);
      if (error <= smallest || timed.seconds > cheapest) break;  // finer settings take longer
    }
  return settings;
}

}  // namespace

/// The arguments are scene files.
int main(int argc, char** argv) {
  const std::vector<double> bounds{0.03, 0.01};
  std::vector<std::vector<double>> ratios(bounds.size());
  std::vector<int> kept(bounds.size());
  for (int i = 1; i < argc; ++i) {
    const Judge judge(argv[i]);
    const std::vector<Setting> settings = measuredSettings(judge, bounds.back());
    for (std::size_t b = 0; b < bounds.size(); ++b) {
      const Timed chosen = solvedWithin(judge, bounds[b]);
      const double error = judge.errorOf(chosen.radiosity);
      const Setting* cheapest = nullptr;
      for (const Setting& setting : settings)
        if (setting.error <= bounds[b] && (cheapest == nullptr || setting.seconds < cheapest->seconds))
          cheapest = &setting;
      kept[b] += error <= bounds[b] ? 1 : 0;
      if (cheapest != nullptr) ratios[b].push_back(chosen.seconds / cheapest->seconds);
      std::printf("%-28s %.3f | %.4f true, %6.3f s | %-24s %.4f true, %6.3f s | %.2f\n", argv[i], bounds[b], error,
                  chosen.seconds, cheapest == nullptr ? "none" : cheapest->name.c_str(),
                  cheapest == nullptr ? 0 : cheapest->error, cheapest == nullptr ? 0 : cheapest->seconds,
                  cheapest == nullptr ? 0 : ratios[b].back());
      std::fflush(stdout);
    }
  }
  for (std::size_t b = 0; b < bounds.size(); ++b) {
    std::sort(ratios[b].begin(), ratios[b].end());
    std::printf("%.3f kept in %d of %d; cost over the cheapest, median %.2f\n", bounds[b], kept[b], argc - 1,
                ratios[b].empty() ? 0 : ratios[b][ratios[b].size() / 2]);
  }
}
