#include "reference/measurement/bench/solution_profile.h"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/solver/shooting_state.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/scenes.h"
#include "reference/measurement/bench/timing.h"

namespace hemitex::reference {
namespace {

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

SolutionParts solveOnce(const radiosity::Scene& scene, radiosity::SceneFormFactors& drawn, int shots) {
  SolutionParts parts;
  const auto timed = [](double& part, const auto& step) {
    const Stopwatch watch;
    auto result = step();
    part += watch.seconds();
    return result;
  };
  const auto state =
      timed(parts.start, [&] { return std::make_unique<radiosity::ShootingState>(scene, drawn.discretization()); });
  for (int shot = 0; shot < shots; ++shot) {
    const std::uint32_t patch = timed(parts.picking, [&] { return state->brightestPatch(); });
    const radiosity::FormFactorRow row = timed(parts.hemicubes, [&] { return drawn.rows().ofPatch(patch); });
    timed(parts.spreading, [&] { return state->shoot(patch, row); });
    timed(parts.accounting, [&] { return state->residual(); });
  }
  timed(parts.accounting, [&] { return state->energy(); });
  timed(parts.accounting, [&] { return std::move(*state).radiosity(); });
  parts.besideOfTotal = parts.beside() / parts.total();
  return parts;
}

/// Heap size while the second row of a solution is summed, including item buffers and the row.
std::size_t heapBytes(const radiosity::Scene& scene, int texels, int resolution) {
  std::size_t whileDrawn = 0;
  const auto probed = [&whileDrawn](raster::DrawList list) {
    return std::make_unique<HeapProbe>(radiosity::softwareRenderer(std::move(list)), whileDrawn);
  };
  radiosity::SceneFormFactors drawn =
      unsplitFormFactors(scene, {.texels = texels}, {.format = "r32ui"}, resolution, probed);
  radiosity::ShootingState state(scene, drawn.discretization());
  state.shoot(state.brightestPatch(), drawn.rows().ofPatch(state.brightestPatch()));
  const std::size_t before = heapBytes();
  const radiosity::FormFactorRow row = drawn.rows().ofPatch(state.brightestPatch());
  return whileDrawn + (heapBytes() - before);
}

}  // namespace

SolutionParts solutionParts(const radiosity::Scene& scene, int texels, int resolution, int shots, int repeats) {
  radiosity::SceneFormFactors drawn = unsplitFormFactors(scene, {.texels = texels}, {.format = "r32ui"}, resolution);
  drawn.rows().ofPatch(0);
  std::vector<SolutionParts> times;
  for (int repeat = 0; repeat < repeats; ++repeat) times.push_back(solveOnce(scene, drawn, shots));
  SolutionParts medians{.elements = drawn.discretization().elements.size(), .resolution = resolution, .shots = shots};
  for (double SolutionParts::*part :
       {&SolutionParts::start, &SolutionParts::picking, &SolutionParts::hemicubes, &SolutionParts::spreading,
        &SolutionParts::accounting, &SolutionParts::besideOfTotal}) {
    std::vector<double> values;
    for (const SolutionParts& repeat : times) values.push_back(repeat.*part);
    medians.*part = medianOf(std::move(values));
  }
  return medians;
}

SolutionMemory solutionMemory(const radiosity::Scene& scene, int texels, int resolution) {
  const raster::ThreadLimit oneThread(1);  // mallinfo2 counts only what the first thread allocated
  const auto elements = [&](int side) {
    return static_cast<double>(radiosity::discretize(scene, {.texels = side}).elements.size());
  };
  const auto pixels = [](int side) { return 3.0 * side * side; };
  const auto heap = [&](int ofTexels, int ofResolution) {
    return static_cast<double>(heapBytes(scene, ofTexels, ofResolution));
  };
  // With few pixels, visible elements add little to the bytes per element.
  constexpr int fewPixels = 64;
  SolutionMemory memory;
  memory.bytesPerElement =
      (heap(texels, fewPixels) - heap(texels / 2, fewPixels)) / (elements(texels) - elements(texels / 2));
  memory.bytesPerPixel =
      (heap(texels, resolution) - heap(texels, resolution / 2)) / (pixels(resolution) - pixels(resolution / 2));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  memory.peakBytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
  return memory;
}

}  // namespace hemitex::reference
