// Hemicubes beside rays and OpenGL, on one core. One iteration measures all, in interleaved repetitions of its own; the
// counters are the results.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "raster/base/parallel.h"
#include "reference/measurement/bench/render_times.h"
#include "tests/benchmarks/drawn_patches.h"
#include "tests/support/subdivided_scene.h"
#ifdef HEMITEX_OPENGL
#include "reference/devices/opengl/opengl_renderer.h"
#endif

using namespace hemitex;

namespace {

reference::BenchSettings settingsOf(int resolution) {
  reference::BenchSettings settings;
  settings.resolutions = {resolution};
#ifdef HEMITEX_OPENGL
  setenv("LP_NUM_THREADS", "1", 1);
  settings.devices.emplace_back("opengl-plain", [](const raster::DrawList& list) {
    return reference::makeOpenGlRenderer(list, reference::OpenGlPath::Plain);
  });
#endif
  return settings;
}

/// A number of triangles, and a time over that of the hemicube.
struct Ratio {
  std::size_t triangles;
  double overHemicube;
};

/// The number of triangles from which on rays are faster. Interpolates linearly between the logarithms of triangles and
/// of ratios. The smallest measured number if rays are always faster, 0 if they never are.
double crossover(const std::vector<Ratio>& rays) {
  if (rays.front().overHemicube < 1) return static_cast<double>(rays.front().triangles);
  const auto many = std::find_if(rays.begin(), rays.end(), [](const Ratio& ratio) { return ratio.overHemicube < 1; });
  if (many == rays.end()) return 0;
  const Ratio& few = *(many - 1);
  const double part = std::log(few.overHemicube) / std::log(few.overHemicube / many->overHemicube);
  const double growth = static_cast<double>(many->triangles) / static_cast<double>(few.triangles);
  return static_cast<double>(few.triangles) * std::pow(growth, part);
}

/// The tasks of `hemitex bench` in a scene that is cut into more and more triangles: times over that of the hemicube,
/// and the crossover of rays.
void triangles(benchmark::State& state, const std::string& name) {
  const reference::BenchScene& bench = tests::sceneNamed(name);
  const std::size_t own = radiosity::triangleCount(bench.scene);
  std::vector<Ratio> rays;
  for (auto _ : state)
    for (const std::size_t count : {own, std::size_t{8000}, std::size_t{100000}, std::size_t{1000000}}) {
      if (count < own) continue;
      reference::BenchScene finer = bench;
      finer.scene = tests::finerScene(bench.scene, count);
      const auto runs = benchRuns(finer, settingsOf(static_cast<int>(state.range(0))), [](const std::string&) {});
      for (const reference::BenchRun& run : runs) {
        const std::string size = " of " + std::to_string(count);
        if (run.what == "hemicube") state.counters["hemicube, ms" + size] = run.seconds.median * 1000;
        const std::optional<double> ratio = overHemicube(run, runs);
        if (ratio) state.counters[run.what + size] = *ratio;
        if (ratio && run.what == "embree") rays.push_back({run.triangles, *ratio});
      }
    }
  state.counters["crossover"] = crossover(rays);
}

/// The error of rows by hemicubes that are rotated per patch, as in solutions, and that by rays of the same time.
void errorAtEqualTime(benchmark::State& state, const std::string& name) {
  const reference::BenchScene& bench = tests::sceneNamed(name);
  const raster::ThreadLimit oneThread(1);
  const auto discretization = radiosity::discretize(bench.scene, bench.elements);
  for (auto _ : state) {
    const reference::RowComparison compared =
        reference::compareRows(bench.scene, discretization,
                               {.hemicubes = {},
                                .turnedHemicubes = {128, 256, 512, 1024},
                                .rays = {1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20},
                                .points = 8,
                                .truthSamples = 1 << 9,
                                .repeats = 11});
    for (const reference::RowQuality& hemicube : compared.turnedHemicubes) {
      const std::optional<double> rays = errorAtTime(compared.rays, hemicube.seconds);
      const std::string size = " at R = " + std::to_string(hemicube.size);
      state.counters["hemicubes" + size] = hemicube.error;
      if (rays) state.counters["rays" + size] = *rays;
      if (rays) state.counters["ratio" + size] = hemicube.error / *rays;
    }
  }
}

void once(benchmark::internal::Benchmark* measured) {
  measured->Iterations(1)->Repetitions(1)->Unit(benchmark::kSecond);
}

void onceByResolution(benchmark::internal::Benchmark* measured) {
  measured->ArgName("R")->RangeMultiplier(2)->Range(128, 1024)->Apply(once);
}

BENCHMARK_CAPTURE(triangles, paper_room, "paper-room")->Apply(onceByResolution);
BENCHMARK_CAPTURE(triangles, cornell_box, "cornell-box")->Apply(onceByResolution);
BENCHMARK_CAPTURE(triangles, gallery, "gallery")->Apply(onceByResolution);
BENCHMARK_CAPTURE(errorAtEqualTime, paper_room, "paper-room")->Apply(once);
BENCHMARK_CAPTURE(errorAtEqualTime, cornell_box, "cornell-box")->Apply(once);

}  // namespace
