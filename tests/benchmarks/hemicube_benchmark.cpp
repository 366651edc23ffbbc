// Times on one core: a hemicube, from a patch's centre to its form-factor row, and the sum of its row alone. Iterations
// cycle through patches of a scene.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/item_buffer_sum.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/parallel.h"
#include "raster/software/software_renderer.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// One iteration is one patch's row; iterations cycle through the patches.
void hemicubeRow(benchmark::State& state, const std::string& file) {
  const raster::ThreadLimit oneThread(1);
  const Scene scene = loadScene(std::string(HEMITEX_DATA) + "/" + file);
  DiscretizationSettings settings;
  settings.texels = static_cast<int>(state.range(1));
  const Discretization discretization = discretize(scene, settings);
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = static_cast<int>(state.range(0))});
  std::uint32_t patch = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(rows.ofPatch(patch));
    patch = (patch + 1) % static_cast<std::uint32_t>(discretization.patches.size());
  }
}

/// One iteration sums one row from item buffers drawn before; reports the time per pixel.
void rowSum(benchmark::State& state, const reference::BenchScene& bench) {
  const raster::ThreadLimit oneThread(1);
  const Discretization discretization = discretize(bench.scene, bench.elements);
  const IdLayout layout = layOut(discretization, bench.ids);
  raster::SoftwareRenderer renderer(makeDrawList(bench.scene, discretization, layout));
  ProjectedFormFactors rows(bench.scene, discretization, layout, renderer,
                            {.resolution = static_cast<int>(state.range(0))});
  const std::vector<Window> windows = wholeFaces(rows.projection());
  constexpr std::size_t patches = 8;
  std::vector<std::vector<raster::ItemBuffer>> drawn;
  for (const std::uint32_t patch : reference::spreadPatches(discretization, patches)) {
    const View view = rows.viewsOfPatch(patch).front();
    raster::draw(renderer, view.faces, view.skipped, drawn.emplace_back());
  }
  ItemBufferSum sum(discretization, layout);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sum.rowOf(rows.projection(), windows, drawn[i]));
    i = (i + 1) % drawn.size();
  }
  const double pixels = 3 * static_cast<double>(state.range(0) * state.range(0));
  state.counters["per pixel"] =
      benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void registerScene(const std::string& file) {
  benchmark::RegisterBenchmark(file.c_str(), [file](benchmark::State& state) { hemicubeRow(state, file); })
      ->ArgNames({"R", "texels"})
      ->ArgsProduct({{128, 256, 512}, {24, 256}})
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  for (const char* file : {"paper-room.obj", "cornell-box.obj", "curved-room.obj"}) registerScene(file);
  const std::vector<reference::BenchScene> scenes = reference::benchScenes(HEMITEX_DATA);
  for (const reference::BenchScene& scene : scenes)
    benchmark::RegisterBenchmark(("row sum, " + scene.name).c_str(),
                                 [&scene](benchmark::State& state) { rowSum(state, scene); })
        ->ArgName("R")
        ->RangeMultiplier(2)
        ->Range(128, 1024)
        ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
