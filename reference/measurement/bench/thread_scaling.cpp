#include "reference/measurement/bench/thread_scaling.h"

#include <array>
#include <atomic>

#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/timing.h"

namespace hemitex::reference {
namespace {

/// Independent chains of multiplications and additions in registers, distributed over the threads.
void multiplyAndAdd() {
  constexpr std::size_t parts = 64;
  constexpr int steps = 40000;
  std::atomic<double> result = 0;
  raster::parallelFor(parts, [&](std::size_t part) {
    std::array<double, 8> chains;
    for (std::size_t k = 0; k < chains.size(); ++k) chains[k] = static_cast<double>(part + k);
    for (int step = 0; step < steps; ++step)
      for (double& value : chains) value = value * 0.999999 + 0.5;
    for (const double value : chains) result = result + value;
  });
}

}  // namespace

std::vector<std::vector<double>> gainsOfSecondCore(std::span<const std::function<void()>> tasks, int repeats) {
  std::vector<std::function<void()>> limited;
  for (const std::function<void()>& task : tasks)
    for (const int threads : {1, 2})
      limited.push_back([&task, threads] {
        const raster::ThreadLimit limit(threads);
        task();
      });
  const std::vector<Timing> timings = shortTaskTimings(limited, repeats);
  std::vector<std::vector<double>> gains;
  for (std::size_t i = 0; i < timings.size(); i += 2)
    gains.push_back(quotients(timings[i].repetitions, timings[i + 1].repetitions));
  return gains;
}

CoreGains coreGains(const std::vector<double>& arithmetic, const std::vector<double>& hemicube,
                    const std::vector<double>& solution) {
  return {medianOf(arithmetic), medianOf(hemicube), medianOf(solution), medianOf(quotients(hemicube, arithmetic)),
          medianOf(quotients(solution, arithmetic))};
}

CoreGains coreGains(const BenchScene& bench, int resolution, int shots, int repeats) {
  radiosity::SceneFormFactors drawn = unsplitFormFactors(bench.scene, bench.elements, bench.ids, resolution);
  const std::vector<std::uint32_t> patches = spreadPatches(drawn.discretization(), 8);
  const auto hemicubes = [&] {
    for (const std::uint32_t patch : patches) drawn.rows().ofPatch(patch);
  };
  const auto solution = [&] {
    const auto rowOf = [&](std::uint32_t patch) { return drawn.rows().ofPatch(patch); };
    radiosity::solve(bench.scene, drawn.discretization(), rowOf, {.residual = 0, .shots = shots, .rowCacheBytes = 0});
  };
  const auto gains =
      gainsOfSecondCore(std::vector<std::function<void()>>{multiplyAndAdd, hemicubes, solution}, repeats);
  return coreGains(gains[0], gains[1], gains[2]);
}

}  // namespace hemitex::reference
