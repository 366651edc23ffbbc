/// The time of a whole solution with a given error of the light (docs/light.md), by hemicubes and by Embree rays:
/// hemitex_time_to_error [--paths N] SCENE.obj...
///
/// The truth is light tracing with N paths (default 2^28). A method takes the first setting whose error is within the
/// bound; the number of pixels or rays doubles from setting to setting. Hemicubes are rotated per patch, with and
/// without splitting of patches. Rays start at the centre of a patch, or anywhere on it, or anywhere on patches that
/// are split as with --method rays. All end when a tenth of the bound is unshot, as with --max-error. The time is from
/// the discretized scene to radiosity, in processor seconds of one thread: the median of interleaved repetitions.
/// Prints a Markdown table with the fastest variant by hemicubes and by rays.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/solver/error_control.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/timing.h"
#include "reference/rows/solution_rows.h"
#include "tests/benchmarks/traced_scene.h"

using namespace hemitex;
using tests::TracedScene;

namespace {

constexpr int rounds = 3;

/// A method of computing form factors, with the settings to try.
struct Variant {
  reference::TradeMethod method;
  bool isRays;
  std::vector<int> settings;
};

/// A variant at the first setting within a bound.
struct Choice {
  const Variant* variant;
  int setting;
  double error;
  reference::Timing seconds = {};
};

/// The rows of `hemitex solve --method rays`: hemicubes determine how patches are split.
reference::TradeRows splitRays(int rays) { return {.others = reference::rayRows({rays, reference::RayStart::Area})}; }

std::vector<Variant> variants() {
  const std::vector<int> resolutions{16, 22, 32, 46, 64, 90, 128, 182, 256, 362, 512, 724, 1024};
  std::vector<int> rays;
  for (int count = 1 << 9; count <= 1 << 20; count *= 2) rays.push_back(count);
  std::vector<Variant> result;
  for (const reference::TradeMethod& method : reference::tradeMethods()) {
    if (method.name == "turned-hemicube" || method.name == "split-hemicube")
      result.push_back({method, false, resolutions});
    if (method.name == "centre-rays" || method.name == "area-rays") result.push_back({method, true, rays});
  }
  reference::TradeMethod split;
  split.name = "split-rays";
  split.rows = splitRays;
  result.push_back({split, true, rays});
  return result;
}

/// Removes the settings that are too coarse; nothing remains if finer ones hardly improve the error.
std::optional<Choice> firstWithin(double bound, Variant& variant, const TracedScene& world) {
  const double residual = radiosity::residualFor(bound);
  double coarser = 2;
  while (!variant.settings.empty()) {
    const int setting = variant.settings.front();
    const double error = world.errorOf(world.solvedBy(variant.method, setting, residual));
    std::fprintf(stderr, "%s %d: %.2f %%\n", variant.method.name.c_str(), setting, 100 * error);
    if (error <= bound) return Choice{&variant, setting, error};
    if (error > 0.97 * coarser)
      variant.settings.clear();
    else
      variant.settings.erase(variant.settings.begin());
    coarser = error;
  }
  return std::nullopt;
}

void measureTimes(std::vector<Choice>& choices, double bound, const TracedScene& world) {
  const raster::ThreadLimit oneThread(1);
  const auto secondsOf = [&](std::size_t i, int) {
    const std::clock_t start = std::clock();
    world.solvedBy(choices[i].variant->method, choices[i].setting, radiosity::residualFor(bound));
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  const std::vector<reference::Timing> timings = reference::interleavedTimings(choices.size(), rounds, secondsOf);
  for (std::size_t i = 0; i < choices.size(); ++i) choices[i].seconds = timings[i];
}

/// The fastest choice by hemicubes, or by rays; null if none keeps the bound.
const Choice* fastest(const std::vector<Choice>& choices, bool isRays) {
  const Choice* found = nullptr;
  for (const Choice& choice : choices)
    if (choice.variant->isRays == isRays && (!found || choice.seconds.median < found->seconds.median)) found = &choice;
  return found;
}

void print(const Choice* choice) {
  if (choice)
    std::printf(" %s, %d | %.2f %% | %.3g |", choice->variant->method.name.c_str(), choice->setting,
                100 * choice->error, choice->seconds.median);
  else
    std::printf(" none | | |");
}

void measure(const std::string& file, int paths) {
  const TracedScene world(file, paths);
  const std::string name = file.substr(file.rfind('/') + 1);
  std::fprintf(stderr, "%s: %zu elements, standard error of the truth %.2f %%\n", name.c_str(), world.truth.size(),
               100 * world.truthError);
  std::vector<Variant> all = variants();
  for (const double bound : {0.03, 0.01, 0.003}) {
    std::vector<Choice> choices;
    for (Variant& variant : all)
      if (const auto choice = firstWithin(bound, variant, world)) choices.push_back(*choice);
    measureTimes(choices, bound, world);
    const Choice *hemicube = fastest(choices, false), *rays = fastest(choices, true);
    std::printf("| %s | %zu | %.2g %% |", name.substr(0, name.rfind('.')).c_str(), world.truth.size(), 100 * bound);
    print(hemicube);
    print(rays);
    if (hemicube && rays) std::printf(" %.2g |", ratioOf(rays->seconds, hemicube->seconds));
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int count, char** arguments) {
  int paths = 1 << 28;
  try {
    std::printf("| scene | elements | error | hemicubes | error | s | rays | error | s | rays over hemicubes |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 1; i < count; ++i) {
      const std::string argument = arguments[i];
      if (i + 1 < count && argument == "--paths")
        paths = std::stoi(arguments[++i]);
      else
        measure(argument, paths);
    }
  } catch (const std::exception& error) {
    std::cerr << "hemitex_time_to_error: " << error.what() << '\n';
    return 2;
  }
}
