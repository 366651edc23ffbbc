// Times of a hemicube on one core: from a patch's centre to its form-factor row, the drawing alone, and the sum of the
// row alone. Iterations cycle through patches of a scene.
#include <benchmark/benchmark.h>

#include "radiosity/scene/load_scene.h"
#include "raster/base/parallel.h"
#include "tests/benchmarks/drawn_patches.h"
#include "tests/support/tied_wall.h"

using namespace hemitex;
using tests::DrawnPatches;

namespace {

constexpr int resolution = 512;  ///< of hemicubes over growing numbers of elements
constexpr std::size_t patches = 8;

/// Calls `task` with the numbers of the patches in turn.
template <typename Task>
void cycle(benchmark::State& state, const Task& task) {
  const raster::ThreadLimit oneThread(1);
  std::size_t patch = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(task(patch));
    patch = (patch + 1) % patches;
  }
}

/// A row of a scene with the same number of texels along the side of each surface.
void row(benchmark::State& state, const std::string& file) {
  const radiosity::Scene scene = radiosity::loadScene(HEMITEX_DATA "/" + file);
  DrawnPatches drawn(scene, {.texels = static_cast<int>(state.range(1))}, {}, static_cast<int>(state.range(0)),
                     patches);
  cycle(state, [&](std::size_t i) { return drawn.rows.ofPatch(drawn.patches[i]); });
}

/// The sum of a row from item buffers drawn before, with its time per pixel.
void rowSum(benchmark::State& state, const std::string& scene) {
  const reference::BenchScene& bench = tests::sceneNamed(scene);
  DrawnPatches drawn(bench.scene, bench.elements, bench.ids, static_cast<int>(state.range(0)), patches);
  cycle(state, [&](std::size_t i) { return drawn.sumOf(i); });
  const double pixels = 3 * static_cast<double>(state.range(0) * state.range(0));
  state.counters["per pixel"] =
      benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// A scene with many elements takes seconds to prepare, so that repetitions share it.
DrawnPatches& growing(const std::string& scene, int texels) {
  static std::map<std::pair<std::string, int>, DrawnPatches> all;
  const radiosity::DiscretizationSettings elements{.texels = texels, .patches = 4};
  return all
      .try_emplace({scene, texels}, tests::sceneNamed(scene).scene, elements, radiosity::IdSettings{.format = "r32ui"},
                   resolution, patches)
      .first->second;
}

/// Drawing without the sum, for a number of elements along the side of each surface.
void growthOfDrawing(benchmark::State& state, const std::string& scene) {
  DrawnPatches& drawn = growing(scene, static_cast<int>(state.range(0)));
  std::vector<raster::ItemBuffer> buffers;
  cycle(state, [&](std::size_t i) {
    raster::draw(drawn.renderer, drawn.views[i].faces, drawn.views[i].skipped, buffers);
    return buffers.data();
  });
}

void growthOfSum(benchmark::State& state, const std::string& scene) {
  DrawnPatches& drawn = growing(scene, static_cast<int>(state.range(0)));
  cycle(state, [&](std::size_t i) { return drawn.sumOf(i); });
}

/// The worst case of exact arithmetic, and the control, which needs none.
void wall(benchmark::State& state, double moved) {
  const int side = static_cast<int>(state.range(0));
  raster::SoftwareRenderer renderer(tests::tiedWall(side, moved));
  const raster::Face face = reference::frontFace(side, 0.5f);
  std::vector<raster::ItemBuffer> buffers;
  cycle(state, [&](std::size_t) {
    raster::draw(renderer, {&face, 1}, {}, buffers);
    return buffers.data();
  });
}

void rowSizes(benchmark::internal::Benchmark* row) {
  row->ArgNames({"R", "texels"})->ArgsProduct({{128, 256, 512}, {24, 256}})->Unit(benchmark::kMillisecond);
}

void resolutions(benchmark::internal::Benchmark* sum) {
  sum->ArgName("R")->RangeMultiplier(2)->Range(128, 1024)->Unit(benchmark::kMillisecond);
}

void sides(benchmark::internal::Benchmark* growth) {
  growth->ArgName("side")->RangeMultiplier(4)->Range(16, 1024)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(row, paper_room, "paper-room.obj")->Apply(rowSizes);
BENCHMARK_CAPTURE(row, cornell_box, "cornell-box.obj")->Apply(rowSizes);
BENCHMARK_CAPTURE(row, curved_room, "curved-room.obj")->Apply(rowSizes);
BENCHMARK_CAPTURE(rowSum, paper_room, "paper-room")->Apply(resolutions);
BENCHMARK_CAPTURE(rowSum, cornell_box, "cornell-box")->Apply(resolutions);
BENCHMARK_CAPTURE(rowSum, gallery, "gallery")->Apply(resolutions);
BENCHMARK_CAPTURE(growthOfDrawing, paper_room, "paper-room")->Apply(sides);
BENCHMARK_CAPTURE(growthOfDrawing, cornell_box, "cornell-box")->Apply(sides);
BENCHMARK_CAPTURE(growthOfSum, paper_room, "paper-room")->Apply(sides);
BENCHMARK_CAPTURE(growthOfSum, cornell_box, "cornell-box")->Apply(sides);
BENCHMARK_CAPTURE(wall, worst_case, 0.0)->ArgName("R")->Arg(32)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wall, control, 1.0 / 3)->ArgName("R")->Arg(32)->Arg(512)->Unit(benchmark::kMillisecond);

}  // namespace
