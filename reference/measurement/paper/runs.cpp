#include "reference/measurement/paper/runs.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <span>

#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/timing.h"

namespace hemitex::reference {
namespace {

/// Forwards drawing to another renderer and measures its time.
class TimedRenderer final : public raster::ItemBufferRenderer {
 public:
  explicit TimedRenderer(raster::ItemBufferRenderer& renderer) : renderer_(renderer) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    const Stopwatch watch;
    raster::draw(renderer_, faces, skipped, buffers);
    seconds_ = watch.seconds();
    raster::parallelFor(faces.size(), drawn);
  }

  /// Seconds of the last drawing.
  double seconds() const { return seconds_; }

 private:
  raster::ItemBufferRenderer& renderer_;
  double seconds_ = 0;
};

/// A measured cell of the tables.
struct Cell {
  const PaperScene* scene = nullptr;
  const PaperLevel* level = nullptr;
  raster::ItemBufferRenderer* renderer = nullptr;
  PaperRun run;
  std::vector<ShotTimes> repeats = {};
};

ShotTimes solveOnce(const Cell& cell) {
  TimedRenderer renderer(*cell.renderer);
  const PaperLevel& level = *cell.level;
  radiosity::ProjectedFormFactors rows(cell.scene->scene, level.discretization, level.layout, renderer,
                                       {.resolution = cell.run.resolution});
  rows.ofPatch(level.discretization.patches.list.front());
  ShotTimes times;
  const auto rowOf = [&](const radiosity::Patch& patch) {
    const Stopwatch watch;
    radiosity::FormFactorRow row = rows.ofPatch(patch);
    times.formFactors.push_back(watch.seconds());
    times.draw.push_back(renderer.seconds());
    return row;
  };
  const Stopwatch watch;
  radiosity::solve({.scene = cell.scene->scene,
                    .discretization = level.discretization,
                    .patches = level.discretization.patches,
                    .rowOf = rowOf,
                    .settings = {.residual = 0, .shots = cell.run.shots, .rowCacheBytes = 0}});
  times.rest = watch.seconds();
  for (const double seconds : times.formFactors) times.rest -= seconds;
  return times;
}

int meshShots(const PaperScene& scene, const PaperLevel& level, const PaperDevice& device) {
  const std::size_t shots = device.maxMeshElements / level.discretization.elements.size();
  return static_cast<int>(std::clamp<std::size_t>(shots, 1, static_cast<std::size_t>(scene.shots)));
}

double sumOfMedians(const std::vector<ShotTimes>& repeats, std::vector<double> ShotTimes::*times) {
  double sum = 0;
  for (std::size_t shot = 0; shot < (repeats.front().*times).size(); ++shot) {
    std::vector<double> ofShot;
    for (const ShotTimes& repeat : repeats) ofShot.push_back((repeat.*times).at(shot));
    sum += medianOf(ofShot);
  }
  return sum;
}

}  // namespace

PaperTimes mediansOf(const std::vector<ShotTimes>& repeats) {
  assert(!repeats.empty());
  std::vector<double> rest;
  for (const ShotTimes& repeat : repeats) rest.push_back(repeat.rest);
  const double formFactors = sumOfMedians(repeats, &ShotTimes::formFactors);
  return {formFactors + medianOf(rest), formFactors, sumOfMedians(repeats, &ShotTimes::draw)};
}

std::vector<PaperRun> measurePaperRuns(const std::vector<PaperScene>& scenes, const std::vector<PaperDevice>& devices,
                                       const PaperSettings& settings,
                                       const std::function<void(double, const std::string&)>& progress) {
  std::vector<std::unique_ptr<raster::ItemBufferRenderer>> renderers;
  std::vector<Cell> cells;
  for (const PaperScene& scene : scenes)
    for (const PaperDevice& device : devices)
      for (const bool isMesh : {false, true})
        for (const PaperLevel& level : scene.levels) {
          const auto elementsBy = isMesh ? radiosity::ElementsBy::Mesh : radiosity::ElementsBy::Texture;
          renderers.push_back(radiosity::sceneRenderer(scene.scene, level.discretization, level.layout, elementsBy,
                                                       device.makeRenderer));
          for (const int resolution : settings.resolutions)
            cells.push_back({&scene,
                             &level,
                             renderers.back().get(),
                             {scene.name,
                              radiosity::triangleCount(scene.scene),
                              device.name,
                              isMesh ? "mesh" : "texture",
                              level.name,
                              resolution,
                              level.discretization.elements.size(),
                              isMesh ? meshShots(scene, level, device) : scene.shots,
                              {}}});
        }
  const auto secondsOf = [&](std::size_t i, int repeat) {
    const PaperRun& run = cells[i].run;
    const double done = repeat + static_cast<double>(i) / static_cast<double>(cells.size());
    if (progress)
      progress(done / settings.repeats, run.scene + ", " + run.level + ", " + run.discretize + ", " + run.device +
                                            ", R = " + std::to_string(run.resolution));
    cells[i].repeats.push_back(solveOnce(cells[i]));
    return mediansOf({cells[i].repeats.back()}).total;
  };
  interleavedTimings(cells.size(), settings.repeats, secondsOf, settings.longTime);
  std::vector<PaperRun> runs;
  for (Cell& cell : cells) {
    cell.run.seconds = mediansOf(cell.repeats);
    runs.push_back(cell.run);
  }
  return runs;
}

}  // namespace hemitex::reference
