/// `hemitex bench`: measures the time of hemicubes, regular meshing, Embree and OpenGL.
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "cli/bench/report.h"
#include "cli/common/commands.h"
#include "cli/common/staging.h"
#include "cli/devices/opengl_device.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "cli/scene/scene_folder.h"
#include "cli/scene/scene_options.h"
#include "radiosity/discretization/discretize.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/measurement/bench/report.h"

namespace hemitex::cli {
namespace {

struct BenchOptions {
  std::filesystem::path output;  ///< empty if no files are written
  std::vector<std::filesystem::path> scenes;
  std::vector<int> resolutions;
  std::vector<std::size_t> triangles;
};

std::vector<reference::BenchScene> scenesOf(const BenchOptions& options) {
  if (options.scenes.empty()) return reference::benchScenes(sceneFolder());
  std::vector<reference::BenchScene> scenes;
  std::set<std::string> names;
  for (const std::filesystem::path& file : options.scenes) {
    scenes.push_back(reference::benchScene(file));
    if (!names.insert(scenes.back().name).second)
      throw raster::InputError(file.string() + ": another scene has the same name", "rename one of the files");
  }
  return scenes;
}

reference::BenchSettings settingsOf(const BenchOptions& options, Context& context) {
  reference::BenchSettings settings;
  if (!options.resolutions.empty()) settings.resolutions = options.resolutions;
  if (!options.triangles.empty() || !options.scenes.empty()) settings.triangles = options.triangles;
  settings.threads = std::max(1, context.threads);
  // Mesa's CPU rasterizer reads this variable when the first context is made; other devices ignore it.
  setenv("LP_NUM_THREADS", std::to_string(settings.threads).c_str(), 1);
  settings.openGl = openGlRenderers(Device::OpenGl, context.console, "OpenGL is not measured");
  if (settings.openGl) settings.plainOpenGl = openGlRenderers(Device::OpenGlPlain, context.console, "");
  return settings;
}

using Progress = std::function<void(const std::string&)>;

/// Measures everything besides the runs, on the first two scenes of the program: the room and the Cornell box.
void measureRest(reference::BenchReport& report, const std::vector<reference::BenchScene>& scenes, Context& context,
                 const reference::BenchSettings& settings, const Progress& progress) {
  constexpr int resolution = 512;
  const reference::BenchScene &room = scenes[0], &box = scenes[1];
  if (context.threads != 1 && std::thread::hardware_concurrency() > 1) {
    progress("two threads");
    report.cores = reference::coreGains(room, resolution, 40, settings.repeats);
  }
  const raster::ThreadLimit limit(settings.threads);
  progress("exact arithmetic");
  for (const int side : {32, resolution}) report.walls.push_back(reference::wallTimes(side, settings.repeats));
  constexpr std::array<int, 4> sides{16, 64, 256, 1024};
  for (const reference::BenchScene* scene : {&room, &box}) {
    progress("finer elements, " + scene->name);
    report.growth.push_back(
        {scene->name, resolution, reference::growthOf(scene->scene, sides, resolution, settings.repeats)});
  }
  for (const reference::BenchScene* scene : {&room, &box}) {
    progress("errors, " + scene->name);
    const reference::RowComparisonSettings rows{.hemicubes = {},
                                                .turnedHemicubes = settings.resolutions,
                                                .rays = {1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20},
                                                .points = 8,
                                                .truthSamples = 1 << 9,
                                                .repeats = settings.repeats};
    const auto discretization = radiosity::discretize(scene->scene, scene->elements);
    const auto errors = equalTimeErrors(scene->name, compareRows(scene->scene, discretization, rows));
    report.errors.insert(report.errors.end(), errors.begin(), errors.end());
  }
  // About a million elements in the scene.
  const int texels = static_cast<int>(std::ceil(1000 / std::sqrt(static_cast<double>(box.scene.surfaces.size()))));
  progress("memory");
  report.memory = reference::solutionMemory(box.scene, texels, resolution);
  progress("parts of a solution");
  for (const int side : settings.resolutions)
    report.parts.push_back(reference::solutionParts(box.scene, texels, side, 300, settings.repeats));
}

void writeFiles(const nlohmann::ordered_json& result, Staging& staging) {
  raster::writeFile(staging.folder() / "bench.json", toText(result));
  raster::writeFile(staging.folder() / "tables.md", benchText(result));
  raster::writeFile(staging.folder() / "report.html", completePage(benchPageText, result));
  staging.commit();
}

void bench(const BenchOptions& options, Context& context) {
  Console& console = context.console;
  std::optional<Staging> staging;
  if (!options.output.empty()) staging.emplace(options.output);
  if (staging)
    staging->requirePlaces({"bench.json", "tables.md", "report.html"}, {options.scenes.begin(), options.scenes.end()});
  const std::vector<reference::BenchScene> scenes = scenesOf(options);
  const reference::BenchSettings settings = settingsOf(options, context);
  reference::BenchReport report;
  double done = 0;
  const double all = static_cast<double>(scenes.size()) + (options.scenes.empty() ? 1 : 0);
  for (const reference::BenchScene& scene : scenes) {
    const auto runs = benchRuns(scene, settings, [&](const std::string& what) { console.progress(done / all, what); });
    report.runs.insert(report.runs.end(), runs.begin(), runs.end());
    ++done;
  }
  if (options.scenes.empty())
    measureRest(report, scenes, context, settings,
                [&](const std::string& what) { console.progress(done / all, what); });
  console.endProgress();
  const nlohmann::ordered_json result = toJson(report);
  if (staging) writeFiles(result, *staging);
  std::cout << (context.json ? toText(result) : benchText(result));
}

}  // namespace

void addBench(Command program, Context& context) {
  const auto options = std::make_shared<BenchOptions>();
  const Command command = program.addCommand("bench",
                                             "Measure the speed of hemicubes compared with meshing, Embree and OpenGL "
                                             "(takes minutes; default: on one thread)");
  const auto readScenes = [options](const std::vector<std::string>& texts) {
    options->scenes.assign(texts.begin(), texts.end());
  };
  command.addTexts(
      "SCENE", "PATH",
      "measure the runs of these scene files only (default: all measurements, with the room of the paper, the "
      "Cornell box and the gallery, also with up to 1,000,000 triangles)",
      readScenes);
  addResolutions(command, options->resolutions);
  const auto readTriangles = [options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      options->triangles.push_back(static_cast<std::size_t>(integerOption("--triangles", text, 1, 100000000)));
  };
  command.addTexts("--triangles", "N",
                   "also measure the scenes cut into N triangles (repeatable; default 8000, 100000 and 1000000; for "
                   "given files none)",
                   readTriangles);
  command.addPath("-o,--output", options->output,
                  "write report.html, bench.json and tables.md into this folder (default: no files)");
  command.addExamples({"data/cornell-box.obj --resolution 256", "data/cornell-box.obj --triangles 100000 -o bench"});
  command.onRead([options, &context] { context.command = [options, &context] { bench(*options, context); }; });
}

}  // namespace hemitex::cli
