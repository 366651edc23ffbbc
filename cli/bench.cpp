/// `hemitex bench`: how fast hemicubes are, beside whatever else gives the same pixels.
#include <cstdlib>
#include <iostream>
#include <memory>

#include "cli/bench_json.h"
#include "cli/bench_text.h"
#include "cli/commands.h"
#include "cli/opengl_device.h"
#include "cli/scene_folder.h"
#include "reference/bench_runs.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

struct BenchOptions {
  std::vector<std::filesystem::path> scenes;
  std::vector<int> resolutions;
  std::vector<std::size_t> triangles;
};

std::vector<reference::BenchScene> scenesOf(const BenchOptions& options) {
  if (options.scenes.empty()) return reference::benchScenes(sceneFolder());
  std::vector<reference::BenchScene> scenes;
  for (const std::filesystem::path& file : options.scenes) scenes.push_back(reference::benchScene(file));
  return scenes;
}

reference::BenchSettings settingsOf(const BenchOptions& options, Context& context) {
  reference::BenchSettings settings;
  if (!options.resolutions.empty()) settings.resolutions = options.resolutions;
  if (!options.triangles.empty() || !options.scenes.empty()) settings.triangles = options.triangles;
  settings.threads = std::max(1, context.threads);
  // Mesa's rasterizer on the CPU reads it when the first context is made. Other devices do not.
  setenv("LP_NUM_THREADS", std::to_string(settings.threads).c_str(), 1);
  settings.openGl = openGlRenderers(context.console, "no times of OpenGL");
  return settings;
}

void bench(const BenchOptions& options, Context& context) {
  Console& console = context.console;
  const std::vector<reference::BenchScene> scenes = scenesOf(options);
  const reference::BenchSettings settings = settingsOf(options, context);
  std::vector<reference::BenchRun> runs;
  for (const reference::BenchScene& scene : scenes) {
    const auto ofScene = benchRuns(scene, settings, [&](const std::string& what) {
      console.progress(static_cast<double>(&scene - scenes.data()) / static_cast<double>(scenes.size()), what);
    });
    runs.insert(runs.end(), ofScene.begin(), ofScene.end());
  }
  console.endProgress();
  if (!context.json) {
    std::cout << runsTable(runs);
    return;
  }
  ordered_json result{{"runs", toJson(runs)}};
  std::cout << toText(result);
}

}  // namespace

void addBench(CLI::App& program, Context& context) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = program.add_subcommand("bench", "Speed, beside meshing, Embree and OpenGL; some minutes' work");
  command->add_option("SCENE", options->scenes,
                      "Wavefront OBJ files (default: the paper's room, the Cornell box and the gallery, also cut)");
  addResolutions(*command, options->resolutions);
  const auto readTriangles = [options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      options->triangles.push_back(static_cast<std::size_t>(integerOption("--triangles", text, 1, 100000000)));
  };
  command
      ->add_option_function<std::vector<std::string>>("--triangles", readTriangles,
                                                      "cut the scenes into so many triangles, too (repeatable)")
      ->allow_extra_args(false)
      ->type_name("N");
  command->callback([options, &context] { context.command = [options, &context] { bench(*options, context); }; });
}

}  // namespace hemitex::cli
