#include "reference/measurement/bench/render_times.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/baseline.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/subdivided_scene.h"
#include "reference/truth/rays/pixel_rays.h"

namespace hemitex::reference {
namespace {

using radiosity::ElementsBy;
using radiosity::ProjectedFormFactors;
using radiosity::View;

/// Patches per repetition for an original scene; a subdivided scene takes one.
constexpr std::size_t patchesAtOnce = 3;

/// A scene with its renderers and ray tracer.
struct World {
  World(const radiosity::Scene& itsScene, const BenchScene& bench, bool hasMesh, const BenchSettings& settings)
      : scene(itsScene),
        discretization(radiosity::discretize(scene, bench.elements)),
        layout(radiosity::layOut(discretization, bench.ids)),
        textures(radiosity::sceneRenderer(scene, discretization, layout, ElementsBy::Texture)),
        mesh(hasMesh ? radiosity::sceneRenderer(scene, discretization, layout, ElementsBy::Mesh) : nullptr),
        openGl(deviceRenderer(settings.openGl)),
        plainOpenGl(deviceRenderer(settings.plainOpenGl)),
        rays(radiosity::makeDrawList(scene, discretization, layout)) {}

  const radiosity::Scene& scene;
  radiosity::Discretization discretization;
  radiosity::IdLayout layout;
  std::unique_ptr<raster::ItemBufferRenderer> textures, mesh, openGl, plainOpenGl;
  PixelRays rays;

 private:
  std::unique_ptr<raster::ItemBufferRenderer> deviceRenderer(const radiosity::RendererFactory& device) const {
    return device ? device(radiosity::makeDrawList(scene, discretization, layout)) : nullptr;
  }
};

/// From this number of triangles on, OpenGL by the rules is measured at the highest resolution only. It spends most of
/// its time on vertices at any resolution, so its ratio is best there.
constexpr std::size_t slowTriangles = 100000;

/// A measured task; one call of `call` counts as `calls` calls.
struct Task {
  std::string what;
  std::function<void()> call;
  std::size_t calls = 1;
};

/// The tasks of a world at one resolution, and their data.
class Tasks {
 public:
  Tasks(World& world, int resolution, std::size_t patches, bool withOpenGl)
      : world_(world),
        patches_(spreadPatches(world.discretization, patches)),
        rows_(world.scene, world.discretization, world.layout, *world.textures, {.resolution = resolution}),
        floor_(world.discretization, world.layout, rows_.projection()) {
    for (const std::uint32_t patch : patches_) {
      views_.push_back(rows_.viewsOfPatch(patch).front());
      drawn_.push_back(render(*world.textures, views_.back().faces, views_.back().skipped));
    }
    add("hemicube", [this](std::size_t i) { rows_.ofPatch(patches_[i]); });
    add("draw", [this](std::size_t i) { draw(i); });
    add("embree", [this](std::size_t i) { world_.rays.cast(views_[i].faces, hits_); });
    // One patch only: a hemicube finds its item IDs in the cache, but those of several patches do not fit there.
    tasks_.push_back({"floor", [this] { floor_.row(drawn_.front()); }});
    if (world.plainOpenGl) addDevice("opengl-plain", *world.plainOpenGl);
    if (world.openGl && withOpenGl) addDevice("opengl", *world.openGl);
    if (!world.mesh) return;
    meshRows_ = std::make_unique<ProjectedFormFactors>(world.scene, world.discretization, world.layout, *world.mesh,
                                                       radiosity::ViewSettings{.resolution = resolution});
    add("hemicube-mesh", [this](std::size_t i) { meshRows_->ofPatch(patches_[i]); });
    tasks_.push_back({"solution", [this] { solve(); }});
  }
  Tasks(const Tasks&) = delete;
  Tasks& operator=(const Tasks&) = delete;

  const std::vector<Task>& tasks() const { return tasks_; }
  std::size_t patches() const { return patches_.size(); }
  /// drawAll draws the faces of all patches and resolves item IDs. sumAll sums the rows from item IDs drawn before.
  void drawAll() {
    for (std::size_t i = 0; i < patches_.size(); ++i) draw(i);
  }
  void sumAll() {
    for (const std::vector<raster::ItemBuffer>& ids : drawn_) floor_.sum(ids);
  }
  /// Shots of the solution; fewer than benchShots if no light is left.
  int shots() const { return shots_; }

 private:
  void add(const std::string& what, const std::function<void(std::size_t)>& ofPatch) {
    const auto all = [this, ofPatch] {
      for (std::size_t i = 0; i < patches_.size(); ++i) ofPatch(i);
    };
    tasks_.push_back({what, all, patches_.size()});
  }

  void addDevice(const std::string& what, raster::ItemBufferRenderer& device) {
    add(what, [this, &device](std::size_t i) { raster::draw(device, views_[i].faces, views_[i].skipped, ids_); });
  }

  void draw(std::size_t i) { raster::draw(*world_.textures, views_[i].faces, views_[i].skipped, ids_); }

  void solve() {
    const auto rowOf = [this](std::uint32_t patch) { return rows_.ofPatch(patch); };
    shots_ = radiosity::solve(world_.scene, world_.discretization, rowOf,
                              {.residual = 0, .shots = benchShots, .rowCacheBytes = 0})
                 .shots;
  }

  World& world_;
  std::vector<std::uint32_t> patches_;
  ProjectedFormFactors rows_;
  std::unique_ptr<ProjectedFormFactors> meshRows_;
  BenchFloor floor_;
  std::vector<View> views_;                             ///< one per patch
  std::vector<std::vector<raster::ItemBuffer>> drawn_;  ///< item buffers of each view
  std::vector<raster::ItemBuffer> ids_, hits_;
  std::vector<Task> tasks_;
  int shots_ = 0;
};

void appendRuns(World& world, const std::string& name, int resolution, const BenchSettings& settings,
                std::vector<BenchRun>& runs) {
  const std::size_t triangles = radiosity::triangleCount(world.scene);
  const bool isHighest = resolution == *std::max_element(settings.resolutions.begin(), settings.resolutions.end());
  const Tasks tasks(world, resolution, world.mesh ? patchesAtOnce : 1, triangles < slowTriangles || isHighest);
  std::vector<std::function<void()>> calls;
  for (const Task& task : tasks.tasks()) calls.push_back(task.call);
  const std::vector<Timing> timings = shortTaskTimings(calls, settings.repeats);
  for (std::size_t t = 0; t < timings.size(); ++t) {
    const Task& task = tasks.tasks()[t];
    BenchRun run{name,
                 triangles,
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

}  // namespace

std::vector<BenchRun> benchRuns(const BenchScene& bench, const BenchSettings& settings,
                                const std::function<void(const std::string&)>& progress) {
  const raster::ThreadLimit limit(settings.threads);
  const std::size_t own = radiosity::triangleCount(bench.scene);
  std::vector<std::size_t> counts{own};
  std::copy_if(settings.triangles.begin(), settings.triangles.end(), std::back_inserter(counts),
               [own](std::size_t count) { return count > own; });
  std::vector<BenchRun> runs;
  for (const std::size_t count : counts) {
    const radiosity::Scene scene = finerScene(bench.scene, count);
    World world(scene, bench, count == own, settings);
    for (const int resolution : settings.resolutions) {
      progress(bench.name + " of " + std::to_string(count) + " triangles, R = " + std::to_string(resolution));
      appendRuns(world, bench.name, resolution, settings, runs);
    }
  }
  return runs;
}

std::vector<GrowthPoint> growthOf(const radiosity::Scene& scene, std::span<const int> sides, int resolution,
                                  int repeats) {
  std::deque<World> worlds;
  std::deque<Tasks> tasks;
  std::vector<std::function<void()>> calls;
  for (const int side : sides) {
    const BenchScene finer{{}, scene, {.texels = side, .patches = 4}, {.format = "r32ui"}};
    Tasks& own =
        tasks.emplace_back(worlds.emplace_back(scene, finer, false, BenchSettings()), resolution, patchesAtOnce, false);
    calls.push_back([&own] { own.drawAll(); });
    calls.push_back([&own] { own.sumAll(); });
  }
  const std::vector<Timing> timings = shortTaskTimings(calls, repeats);
  std::vector<GrowthPoint> points;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto patches = static_cast<double>(tasks[i].patches());
    points.push_back(
        {sides[i], worlds[i].discretization.elements.size(), timings[2 * i] / patches, timings[2 * i + 1] / patches});
  }
  return points;
}

}  // namespace hemitex::reference
