#include "reference/bench_cores.h"

#include <array>
#include <atomic>

#include "radiosity/drawn_rows.h"
#include "radiosity/solver.h"
#include "raster/parallel.h"
#include "reference/row_comparison.h"
#include "reference/timing.h"

namespace hemitex::reference {
namespace {

/// Independent chains of multiplications and additions in registers, in parts that any thread takes.
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

CoreGains coreGains(const BenchScene& bench, int resolution, int shots, int repeats) {
  radiosity::DrawnRows drawn(bench.scene, radiosity::discretize(bench.scene, bench.elements),
                             radiosity::layOut(radiosity::discretize(bench.scene, bench.elements), bench.words),
                             {.resolution = resolution, .split = 1});
  const std::vector<std::uint32_t> patches = spreadPatches(drawn.discretization(), 8);
  const auto hemicubes = [&] {
    for (const std::uint32_t patch : patches) drawn.rows().ofPatch(patch);
  };
  const auto solution = [&] {
    const auto rowOf = [&](std::uint32_t patch) { return drawn.rows().ofPatch(patch); };
    radiosity::solve(bench.scene, drawn.discretization(), rowOf, {.residual = 0, .shots = shots, .rowCacheBytes = 0});
  };
  std::vector<std::function<void()>> tasks;
  for (const std::function<void()>& task : {std::function<void()>(multiplyAndAdd), {hemicubes}, {solution}})
    for (const int threads : {1, 2})
      tasks.push_back([task, threads] {
        const raster::ThreadLimit limit(threads);
        task();
      });
  const std::vector<Timing> timings = timeInTurns(tasks, repeats);
  const auto gain = [&](std::size_t task) { return timings[2 * task].median / timings[2 * task + 1].median; };
  return {gain(0), gain(1), gain(2)};
}

}  // namespace hemitex::reference
