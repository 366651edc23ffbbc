/// `hemitex bench`: measures the time of hemicubes, regular meshing, Embree and OpenGL.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

#include "cli/common/commands.h"
#include "cli/common/program.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"
#include "cli/devices/row_device.h"
#include "cli/report/bench_report.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "cli/scene/scene_options.h"
#include "radiosity/discretization/discretize.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/measurement/bench/render_times.h"
#include "reference/measurement/paper/scenes.h"
#include "reference/measurement/rates/row_rates.h"

namespace hemitex::cli {
namespace {

struct BenchOptions {
  std::filesystem::path output;  ///< empty if no files are written
  std::vector<std::filesystem::path> scenes;
  std::vector<int> resolutions;
  bool rows = false;
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
  settings.threads = std::max(1, context.threads);
  // Mesa's CPU rasterizer reads this variable when the first context is made; other devices ignore it.
  setenv("LP_NUM_THREADS", std::to_string(settings.threads).c_str(), 1);
  for (const auto& [what, device] : {std::pair{"opengl-plain", Device::OpenGlPlain}, {"opengl", Device::OpenGl}})
    if (const auto makeRenderer = openGlRenderers(device, context.console, std::string(what) + " is not measured"))
      settings.devices.emplace_back(what, makeRenderer);
  return settings;
}

void writeFiles(const nlohmann::ordered_json& result, Staging& staging) {
  raster::writeFile(staging.folder() / "bench.json", toText(result));
  raster::writeFile(staging.folder() / "tables.md", benchText(result));
  raster::writeFile(staging.folder() / "report.html", completePage(benchPageText, result));
  staging.commit();
}

/// The room and the gallery of the paper over its levels, or the given scenes as they are.
std::vector<reference::PaperScene> rowScenes(const BenchOptions& options) {
  std::vector<reference::PaperScene> scenes;
  if (options.scenes.empty()) {
    scenes = reference::paperScenes(sceneFolder());
    scenes.resize(2);
    return scenes;
  }
  for (reference::BenchScene& bench : scenesOf(options)) {
    radiosity::Discretization discretization = radiosity::discretize(bench.scene, bench.elements);
    radiosity::IdLayout layout = radiosity::layOut(discretization, bench.ids);
    scenes.push_back({bench.name, std::move(bench.scene), {{"default", std::move(discretization), std::move(layout)}}});
  }
  return scenes;
}

/// Prints the rows per second by the processor and by the devices that may be trusted.
void benchRows(const BenchOptions& options, Context& context) {
  reference::RowRateSettings settings{.threads = std::max(1, context.threads)};
  if (!options.resolutions.empty()) settings.resolutions = options.resolutions;
  std::vector<reference::PaperDevice> devices;
  for (const auto& [name, device] :
       {std::pair{"vulkan", Device::Vulkan}, {"vulkan-compute", Device::VulkanCompute}, {"opengl", Device::OpenGl}})
    try {
      devices.push_back({name, rowRenderers({device}, context.console)});
    } catch (const raster::InputError& error) {
      context.console.message(std::string(name) + " is not measured: " + error.what());
    }
  const auto progress = [&](const std::string& what) { context.console.progress(0, what); };
  const nlohmann::ordered_json rates =
      listOf(reference::rowRates(rowScenes(options), devices, settings, progress),
             [](const reference::RowRate& rate) -> nlohmann::ordered_json {
               return {{"scene", rate.scene},           {"level", rate.level}, {"elements", rate.elements},
                       {"resolution", rate.resolution}, {"rows", rate.what},   {"per_second", rate.rowsPerSecond}};
             });
  context.console.endProgress();
  if (context.json)
    std::cout << toText({{"rates", rates}});
  else
    writeMarkdown(std::cout, "Rows per second", rates);
}

void bench(const BenchOptions& options, Context& context) {
  if (options.rows) return benchRows(options, context);
  Console& console = context.console;
  std::optional<Staging> staging;
  if (!options.output.empty())
    staging.emplace(Output{.place = options.output, .writer = "bench", .inputs = context.inputs()});
  if (staging) staging->requirePlaces({"bench.json", "tables.md", "report.html"});
  const std::vector<reference::BenchScene> scenes = scenesOf(options);
  const reference::BenchSettings settings = settingsOf(options, context);
  std::vector<reference::BenchRun> runs;
  double done = 0;
  for (const reference::BenchScene& scene : scenes) {
    const auto progress = [&](const std::string& what) {
      console.progress(done / static_cast<double>(scenes.size()), what);
    };
    const std::vector<reference::BenchRun> ofScene = benchRuns(scene, settings, progress);
    runs.insert(runs.end(), ofScene.begin(), ofScene.end());
    ++done;
  }
  console.endProgress();
  const nlohmann::ordered_json result = benchJson(runs);
  if (staging) writeFiles(result, *staging);
  std::cout << (context.json ? toText(result) : benchText(result));
}

}  // namespace

void addBench(Command program, Context& context) {
  const auto options = std::make_shared<BenchOptions>();
  const Command command = program.addCommand("bench",
                                             "Measure the speed of hemicubes compared with meshing, Embree and OpenGL "
                                             "(takes minutes; default: on one thread)");
  command.addPaths("SCENE", options->scenes,
                   "measure these scene files (default: the room of the paper, the Cornell box and the gallery)");
  addResolutions(command, options->resolutions);
  command.addOutputFolder("-o,--output", options->output,
                          "write report.html, bench.json and tables.md into this folder (default: no files)");
  command
      .addFlag("--rows", options->rows,
               "print only how many rows a second threads and devices compute, over the levels of the paper")
      .excludes(command.option("--output"));
  command.addExamples({"data/cornell-box.obj --resolution 256 -o bench", "--rows --threads 16"});
  command.onRead([options, &context] { context.command = [options, &context] { bench(*options, context); }; });
}

}  // namespace hemitex::cli
