#include "reference/measurement/rates/row_rates.h"

#include <algorithm>
#include <memory>

#include "radiosity/form_factors/projected_form_factors.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/timing.h"

namespace hemitex::reference {
namespace {

/// A renderer whose pixels are read back.
class ReadBack final : public raster::ItemBufferRenderer {
 public:
  explicit ReadBack(raster::ItemBufferRenderer& renderer) : renderer_(renderer) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    renderer_.draw(faces, skipped, buffers, drawn);
  }

 private:
  raster::ItemBufferRenderer& renderer_;
};

/// Rows of a renderer.
struct Method {
  std::string what;
  int threads = 1;
  std::unique_ptr<raster::ItemBufferRenderer> renderer, readBack = {};
  std::unique_ptr<radiosity::ProjectedFormFactors> rows = {};
};

/// The methods of a level, each with a renderer of its own.
std::vector<Method> methodsOf(const PaperScene& scene, const PaperLevel& level, int resolution,
                              const std::vector<PaperDevice>& devices, int threads) {
  std::vector<Method> methods;
  const auto renderer = [&](const radiosity::RendererFactory& make) {
    return radiosity::sceneRenderer(scene.scene, level.discretization, level.layout, radiosity::ElementsBy::Texture,
                                    make);
  };
  const auto add = [&](Method method, raster::ItemBufferRenderer& drawing) {
    method.rows = std::make_unique<radiosity::ProjectedFormFactors>(
        scene.scene, level.discretization, level.layout, drawing, radiosity::ViewSettings{.resolution = resolution});
    methods.push_back(std::move(method));
  };
  const auto addSoftware = [&](int used, const std::string& unit) {
    Method method{"software, " + std::to_string(used) + unit, used, renderer(radiosity::softwareRenderer)};
    raster::ItemBufferRenderer& drawing = *method.renderer;
    add(std::move(method), drawing);
  };
  addSoftware(1, " thread");
  if (threads > 1) addSoftware(threads, " threads");
  for (const PaperDevice& device : devices) {
    Method method{device.name + ", read back", threads, renderer(device.makeRenderer)};
    method.readBack = std::make_unique<ReadBack>(*method.renderer);
    raster::ItemBufferRenderer& drawing = *method.readBack;
    add(std::move(method), drawing);
    Method summed{device.name + ", summed", threads, renderer(device.makeRenderer)};
    raster::ItemBufferRenderer& summing = *summed.renderer;
    add(std::move(summed), summing);
    if (!methods.back().rows->areFasterTogether()) methods.pop_back();
  }
  return methods;
}

}  // namespace

std::vector<RowRate> rowRates(const std::vector<PaperScene>& scenes, const std::vector<PaperDevice>& devices,
                              const RowRateSettings& settings,
                              const std::function<void(const std::string& what)>& progress) {
  std::vector<RowRate> rates;
  for (const PaperScene& scene : scenes)
    for (const PaperLevel& level : scene.levels)
      for (const int resolution : settings.resolutions) {
        progress(scene.name + ", " + level.name + ", R = " + std::to_string(resolution));
        const std::vector<Method> methods = methodsOf(scene, level, resolution, devices, settings.threads);
        const std::size_t count = std::clamp(32768 / resolution, 1, 256);
        std::vector<std::vector<radiosity::ViewPoint>> points;
        for (const radiosity::Patch& patch : spreadPatches(level.discretization, count))
          points.push_back(methods.front().rows->pointsOfPatch(patch));
        std::vector<std::function<void()>> tasks;
        for (const Method& method : methods)
          tasks.push_back([&method, &points] {
            const raster::ThreadLimit limit(method.threads);
            method.rows->ofManyPoints(points);
          });
        const std::vector<Timing> timings = shortTaskTimings(tasks, settings.repeats, 0.1);
        for (std::size_t m = 0; m < methods.size(); ++m)
          rates.push_back({scene.name, level.name, radiosity::triangleCount(scene.scene),
                           level.discretization.elements.size(), resolution, methods[m].what,
                           static_cast<double>(points.size()) / timings[m].median});
      }
  return rates;
}

}  // namespace hemitex::reference
