// Parts of the time of a solution and its memory, in a Cornell box of about a million elements. Times on one and two
// threads.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sys/resource.h>

#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/solver/shooting_state.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/timing.h"
#include "tests/benchmarks/drawn_patches.h"

using namespace hemitex;

namespace {

/// Form factors from patches without splitting. The scene must outlive this object.
struct Unsplit {
  const radiosity::Scene& scene;
  radiosity::Discretization discretization;
  radiosity::SceneFormFactors drawn;

  Unsplit(const radiosity::Scene& ofElements, const radiosity::DiscretizationSettings& elements, int resolution,
          const radiosity::RendererFactory& renderer = radiosity::softwareRenderer)
      : scene(ofElements),
        discretization(radiosity::discretize(scene, elements)),
        drawn(scene, discretization, radiosity::layOut(discretization, {.format = "r32ui"}),
              {.resolution = resolution, .split = 1}, renderer) {}

  radiosity::ShootingState start() const {
    const radiosity::Patches& patches = discretization.patches;
    return {scene, discretization, patches, radiosity::nothingShot(patches, radiosity::bandCount(scene))};
  }
  radiosity::FormFactorRow row(std::uint32_t patch) {
    return drawn.uncorrected().ofPatch(discretization.patches.list[patch]);
  }
};

const radiosity::Scene& cornellBox() { return tests::sceneNamed("cornell-box").scene; }

/// Texels along the side of each surface, for about a million elements in the scene.
int texelsOfAMillion() {
  return static_cast<int>(std::ceil(1000 / std::sqrt(static_cast<double>(cornellBox().surfaces.size()))));
}

/// One iteration is a solution; repeats the steps of the solver (progressive_solver.h) one by one. The counters are
/// percentages of its time: `beside` is all but hemicubes.
void parts(benchmark::State& state) {
  constexpr int shots = 300;
  const raster::ThreadLimit oneThread(1);
  const int resolution = static_cast<int>(state.range(0));
  Unsplit drawn(cornellBox(), {.texels = texelsOfAMillion()}, resolution);
  double start = 0, picking = 0, hemicubes = 0, spreading = 0, accounting = 0;
  const auto timed = [](double& part, const auto& step) {
    const reference::Stopwatch watch;
    auto result = step();
    part += watch.seconds();
    return result;
  };
  for (auto _ : state) {
    const auto solver = timed(start, [&] { return std::make_unique<radiosity::ShootingState>(drawn.start()); });
    for (int shot = 0; shot < shots; ++shot) {
      const std::uint32_t patch = timed(picking, [&] { return solver->brightestPatch(); });
      const radiosity::FormFactorRow row = timed(hemicubes, [&] { return drawn.row(patch); });
      timed(spreading, [&] { return solver->shoot(patch, row); });
      timed(accounting, [&] { return solver->residual(); });
    }
    timed(accounting, [&] { return solver->energy(); });
    timed(accounting, [&] { return std::move(*solver).radiosity(); });
  }
  const double total = start + picking + hemicubes + spreading + accounting;
  for (const auto& [name, part] : {std::pair{"start", start},
                                   {"picking", picking},
                                   {"hemicubes", hemicubes},
                                   {"spreading", spreading},
                                   {"accounting", accounting},
                                   {"beside", total - hemicubes}})
    state.counters[name] = 100 * part / total;
}

/// Bytes that the heap holds.
std::size_t heapBytes() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// Records the heap size while item buffers exist.
class HeapProbe final : public raster::ItemBufferRenderer {
 public:
  HeapProbe(std::unique_ptr<raster::ItemBufferRenderer> renderer, std::size_t& bytes)
      : renderer_(std::move(renderer)), bytes_(bytes) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    renderer_->draw(faces, skipped, buffers, drawn);
    bytes_ = heapBytes();
  }

 private:
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  std::size_t& bytes_;
};

/// Heap size while the second row of a solution is summed, including item buffers and the row.
double heapOf(int texels, int resolution) {
  std::size_t whileDrawn = 0;
  const auto probed = [&whileDrawn](raster::DrawList list) {
    return std::make_unique<HeapProbe>(radiosity::softwareRenderer(std::move(list)), whileDrawn);
  };
  Unsplit drawn(cornellBox(), {.texels = texels}, resolution, probed);
  radiosity::ShootingState state = drawn.start();
  state.shoot(state.brightestPatch(), drawn.row(state.brightestPatch()));
  const std::size_t before = heapBytes();
  const radiosity::FormFactorRow row = drawn.row(state.brightestPatch());
  return static_cast<double>(whileDrawn + (heapBytes() - before));
}

/// Memory of a solution while it sums a row, without the scene: elements, patches, tables, index maps, light, item
/// buffers and the row. Bytes per element and per pixel are differences of the heap size. The second solution has four
/// times as many elements, or pixels. Needs an allocator that supports mallinfo2.
void memory(benchmark::State& state) {
  const raster::ThreadLimit oneThread(1);  // mallinfo2 counts only what the first thread allocated
  const auto elements = [](int side) {
    return static_cast<double>(radiosity::discretize(cornellBox(), {.texels = side}).elements.size());
  };
  const auto pixels = [](int side) { return 3.0 * side * side; };
  // With few pixels, visible elements add little to the bytes per element.
  constexpr int few = 64, many = 512;
  const int texels = texelsOfAMillion();
  for (auto _ : state) {
    state.counters["bytes per element"] =
        (heapOf(texels, few) - heapOf(texels / 2, few)) / (elements(texels) - elements(texels / 2));
    state.counters["bytes per pixel"] =
        (heapOf(texels, many) - heapOf(texels, many / 2)) / (pixels(many) - pixels(many / 2));
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak bytes"] = static_cast<double>(usage.ru_maxrss) * 1024;
}

/// Independent chains of multiplications and additions in registers: the speed-up without memory access.
void arithmetic(benchmark::State& state) {
  constexpr std::size_t independentParts = 64;
  constexpr int steps = 40000;
  const raster::ThreadLimit limit(static_cast<int>(state.range(0)));
  std::atomic<double> result = 0;
  for (auto _ : state)
    raster::parallelFor(independentParts, [&](std::size_t part) {
      std::array<double, 8> chains;
      for (std::size_t k = 0; k < chains.size(); ++k) chains[k] = static_cast<double>(part + k);
      for (int step = 0; step < steps; ++step)
        for (double& value : chains) value = value * 0.999999 + 0.5;
      for (const double value : chains) result = result + value;
    });
}

constexpr int threadsResolution = 512;

void hemicubes(benchmark::State& state) {
  const reference::BenchScene& room = tests::sceneNamed("paper-room");
  const raster::ThreadLimit limit(static_cast<int>(state.range(0)));
  tests::DrawnPatches drawn(room.scene, room.elements, room.ids, threadsResolution, 8);
  for (auto _ : state)
    for (const radiosity::Patch& patch : drawn.patches) benchmark::DoNotOptimize(drawn.rows.ofPatch(patch));
}

void solution(benchmark::State& state) {
  const reference::BenchScene& room = tests::sceneNamed("paper-room");
  const raster::ThreadLimit limit(static_cast<int>(state.range(0)));
  Unsplit drawn(room.scene, room.elements, threadsResolution);
  for (auto _ : state)
    radiosity::solve({.scene = room.scene,
                      .discretization = drawn.discretization,
                      .patches = drawn.discretization.patches,
                      .rowOf = drawn.drawn.rowOf(),
                      .settings = {.residual = 0, .shots = 40, .rowCacheBytes = 0}});
}

void oneAndTwo(benchmark::internal::Benchmark* threaded) {
  threaded->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(parts)->ArgName("R")->RangeMultiplier(2)->Range(128, 1024)->Unit(benchmark::kMillisecond);
BENCHMARK(memory)->Iterations(1)->Repetitions(1)->Unit(benchmark::kSecond);
BENCHMARK(arithmetic)->Apply(oneAndTwo);
BENCHMARK(hemicubes)->Apply(oneAndTwo);
BENCHMARK(solution)->Apply(oneAndTwo);

}  // namespace
