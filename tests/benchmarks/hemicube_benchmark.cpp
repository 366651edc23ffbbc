// The time of a hemicube on one core, from a patch's centre to its form-factor row, over all patches of a scene.
#include <benchmark/benchmark.h>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/parallel.h"
#include "raster/software/software_renderer.h"

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

void registerScene(const std::string& file) {
  benchmark::RegisterBenchmark(file.c_str(), [file](benchmark::State& state) { hemicubeRow(state, file); })
      ->ArgNames({"R", "texels"})
      ->ArgsProduct({{128, 256, 512}, {24, 256}})
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  for (const char* file : {"paper-room.obj", "cornell-box.obj", "curved-room.obj"}) registerScene(file);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
