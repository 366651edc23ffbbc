#include "reference/measurement/bench/render_times.h"

#include <algorithm>
#include <memory>
#include <tuple>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/item_buffer_sum.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"
#include "raster/base/pool.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/truth/rays/pixel_rays.h"

namespace hemitex::reference {
namespace {

using radiosity::View;

/// Patches per repetition.
constexpr std::size_t patchesAtOnce = 3;

/// Seconds for which a device draws before it is measured.
constexpr double deviceWarmUp = 0.1;

/// The renderers and the ray tracer of a scene.
struct World {
  World(const BenchScene& bench, const BenchSettings& settings)
      : scene(bench.scene),
        discretization(radiosity::discretize(scene, bench.elements)),
        layout(radiosity::layOut(discretization, bench.ids)),
        rays(radiosity::makeDrawList(scene, discretization, layout)) {
    for (const auto& [what, makeRenderer] : settings.devices)
      devices.emplace_back(what, makeRenderer(radiosity::makeDrawList(scene, discretization, layout)));
  }

  const radiosity::Scene& scene;
  radiosity::Discretization discretization;
  radiosity::IdLayout layout;
  PixelRays rays;
  std::vector<std::pair<std::string, std::unique_ptr<raster::ItemBufferRenderer>>> devices;
};

/// Bytes per pixel that the reference renderer clears besides the item ID: depth and visible triangle.
constexpr std::size_t fragmentBytes = 12;

/// Clears as many bytes as drawing that many pixels, in parts that stay in the cache of a thread.
std::function<void()> clearing(std::size_t pixels) {
  const auto ids = std::make_shared<std::vector<raster::ItemId>>(pixels);  // of all faces
  const auto fragments = std::make_shared<raster::Pool<std::vector<std::byte>>>();
  return [ids, fragments] {
    static constexpr std::size_t part = 32768;
    raster::parallelFor((ids->size() + part - 1) / part, [&](std::size_t i) {
      const std::size_t first = i * part, count = std::min(part, ids->size() - first);
      fragments->with([&](auto& ofThread) { ofThread.assign(count * fragmentBytes, std::byte{0}); });
      std::fill_n(ids->begin() + static_cast<std::ptrdiff_t>(first), count, raster::ItemId{0});
    });
  };
}

/// A measured task; one call of `call` counts as `calls` calls.
struct Task {
  std::string what;
  std::function<void()> call;
  std::size_t calls = 1;
};

/// The tasks of a world at one resolution, and their data.
class Tasks {
 public:
  Tasks(World& world, int resolution)
      : world_(world),
        patches_(spreadPatches(world.discretization, patchesAtOnce)),
        rows_(world.scene, world.discretization, world.layout, {.resolution = resolution},
              [this](raster::DrawList list) {
                auto renderer = radiosity::softwareRenderer(std::move(list));
                textures_ = renderer.get();
                return renderer;
              }),
        meshRows_(world.scene, world.discretization, world.layout,
                  {.resolution = resolution, .split = 1, .elementsBy = radiosity::ElementsBy::Mesh}),
        sum_(world.discretization, world.layout) {
    for (const radiosity::Patch& patch : patches_) views_.push_back(rows_.uncorrected().viewsOfPatch(patch).front());
    add("hemicube", [this](std::size_t i) { rows_.row(patches_[i]); });
    addDrawing("draw", *textures_);
    add("embree", [this](std::size_t i) { world_.rays.cast(views_[i].faces, hits_); });
    addFloor();
    for (const auto& [what, device] : world.devices) addDrawing(what, *device);
    add("hemicube-mesh", [this](std::size_t i) { meshRows_.row(patches_[i]); });
    tasks_.push_back({"solution", [this] { solve(); }});
  }
  Tasks(const Tasks&) = delete;
  Tasks& operator=(const Tasks&) = delete;

  const std::vector<Task>& tasks() const { return tasks_; }
  /// Shots of the solution; fewer than benchShots if no light is left.
  int shots() const { return shots_; }

 private:
  void add(const std::string& what, const std::function<void(std::size_t)>& ofPatch) {
    const auto all = [this, ofPatch] {
      for (std::size_t i = 0; i < patches_.size(); ++i) ofPatch(i);
    };
    tasks_.push_back({what, all, patches_.size()});
  }

  /// One patch only: a hemicube finds its item IDs in the cache, but those of several patches do not fit there.
  void addFloor() {
    const auto drawn = render(*textures_, views_.front().faces, views_.front().skipped);
    std::size_t pixels = 0;
    for (const raster::ItemBuffer& buffer : drawn) pixels += buffer.ids.size();
    const auto clearAndSum = [this, drawn, clear = clearing(pixels), &projection = rows_.uncorrected().projection()] {
      clear();
      sum_.rowOf(projection, radiosity::wholeFaces(projection), drawn);
    };
    tasks_.push_back({"floor", clearAndSum});
  }

  void addDrawing(const std::string& what, raster::ItemBufferRenderer& renderer) {
    add(what, [this, &renderer](std::size_t i) { raster::draw(renderer, views_[i].faces, views_[i].skipped, ids_); });
  }

  void solve() {
    shots_ = radiosity::solve({.scene = world_.scene,
                               .discretization = world_.discretization,
                               .patches = world_.discretization.patches,
                               .rowOf = rows_.rowOf(),
                               .split = rows_.splits(),
                               .settings = {.residual = 0, .shots = benchShots, .rowCacheBytes = 0}})
                 .shots;
  }

  World& world_;
  std::vector<radiosity::Patch> patches_;
  raster::ItemBufferRenderer* textures_ = nullptr;  ///< of `rows_`
  radiosity::SceneFormFactors rows_, meshRows_;
  radiosity::ItemBufferSum sum_;
  std::vector<View> views_;  ///< one per patch
  std::vector<raster::ItemBuffer> ids_, hits_;
  std::vector<Task> tasks_;
  int shots_ = 0;
};

void appendRuns(World& world, const std::string& name, int resolution, const BenchSettings& settings,
                std::vector<BenchRun>& runs) {
  const Tasks tasks(world, resolution);
  std::vector<std::function<void()>> calls;
  std::vector<double> warmUps;
  for (const Task& task : tasks.tasks()) {
    calls.push_back(task.call);
    warmUps.push_back(task.what.starts_with("opengl") ? deviceWarmUp : 0);
  }
  const std::vector<Timing> timings = shortTaskTimings(calls, settings.repeats, shortestRepetition, warmUps);
  for (std::size_t t = 0; t < timings.size(); ++t) {
    const Task& task = tasks.tasks()[t];
    BenchRun run{name,
                 radiosity::triangleCount(world.scene),
                 world.discretization.elements.size(),
                 resolution,
                 settings.threads,
                 task.what,
                 timings[t] / static_cast<double>(task.calls)};
    runs.push_back(run);
    if (task.what != "solution") continue;
    run.what = "shot";
    run.seconds = run.seconds / tasks.shots();
    runs.push_back(run);
  }
}

const BenchRun* runAt(const std::vector<BenchRun>& runs, const BenchRun& place, const std::string& what) {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const BenchRun& run) {
    return run.what == what && std::tie(run.scene, run.triangles, run.resolution) ==
                                   std::tie(place.scene, place.triangles, place.resolution);
  });
  return found == runs.end() ? nullptr : &*found;
}

/// Whether the run is of OpenGL, and the other path of OpenGL is faster.
bool isSlowerOpenGl(const BenchRun& run, const std::vector<BenchRun>& runs) {
  if (!run.what.starts_with("opengl")) return false;
  const BenchRun* const other = runAt(runs, run, run.what == "opengl" ? "opengl-plain" : "opengl");
  return other && ratioOf(other->seconds, run.seconds) < 1;
}

}  // namespace

std::vector<BenchRun> benchRuns(const BenchScene& bench, const BenchSettings& settings,
                                const std::function<void(const std::string&)>& progress) {
  const raster::ThreadLimit limit(settings.threads);
  World world(bench, settings);
  std::vector<BenchRun> runs;
  for (const int resolution : settings.resolutions) {
    progress(bench.name + ", R = " + std::to_string(resolution));
    appendRuns(world, bench.name, resolution, settings, runs);
  }
  return runs;
}

std::optional<double> overHemicube(const BenchRun& run, const std::vector<BenchRun>& runs) {
  const BenchRun* const hemicube = runAt(runs, run, "hemicube");
  const bool hasOtherPatches = run.what == "shot" || run.what == "solution";
  if (!hemicube || run.what == "hemicube" || hasOtherPatches || isSlowerOpenGl(run, runs)) return std::nullopt;
  return ratioOf(run.seconds, hemicube->seconds);
}

}  // namespace hemitex::reference
