#include "reference/measurement/rates/row_rates.h"

#include <algorithm>
#include <memory>

#include "radiosity/form_factors/projected_form_factors.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/timing.h"
#include "reference/measurement/rates/read_back.h"

namespace hemitex::reference {
namespace {

/// Rows of a renderer.
struct Method {
  std::string what;
  int threads = 1;
  std::unique_ptr<raster::ItemBufferRenderer> renderer;
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
  const auto add = [&](const std::string& what, int used, std::unique_ptr<raster::ItemBufferRenderer> drawing) {
    Method method{what, used, std::move(drawing)};
    method.rows = std::make_unique<radiosity::ProjectedFormFactors>(scene.scene, level.discretization, level.layout,
                                                                    *method.renderer,
                                                                    radiosity::ViewSettings{.resolution = resolution});
    methods.push_back(std::move(method));
  };
  add("software, 1 thread", 1, renderer(radiosity::softwareRenderer));
  if (threads > 1)
    add("software, " + std::to_string(threads) + " threads", threads, renderer(radiosity::softwareRenderer));
  for (const PaperDevice& device : devices) {
    add(device.name + ", read back", threads, std::make_unique<ReadBack>(renderer(device.makeRenderer)));
    add(device.name + ", summed", threads, renderer(device.makeRenderer));
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
