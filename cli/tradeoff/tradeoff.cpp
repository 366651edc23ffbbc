/// `hemitex tradeoff`: measures time and error of every method on a scene. Compares all settings and several grids with
/// the true radiosity, and writes numbers and a page with plots and error pictures.
#include "reference/measurement/tradeoff/tradeoff.h"

#include <algorithm>
#include <bit>
#include <iostream>
#include <memory>
#include <sstream>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/devices/row_device.h"
#include "cli/report/tradeoff_report.h"
#include "cli/scene/camera_options.h"
#include "cli/scene/scene_options.h"
#include "radiosity/discretization/discretize.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/stopwatch.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

struct TradeoffOptions {
  SceneOptions scene;
  std::vector<int> texels = {16, 8, 4}, patches = {4, 1, 2, 8};
  int samples = 1 << 14;
  std::uint32_t seed = 0;
  std::vector<std::string> methodTexts;  ///< as given; all methods if empty
  std::vector<reference::TradeMethod> methods;
  RowDevice device;
  RendererMaker makeRenderer = radiosity::softwareRenderer;  ///< of the device
  std::filesystem::path output;
};

constexpr int maxTexels = 4096;

constexpr int maxSamePointsResolution = 1024, maxSamePointsRays = 1 << 22;

/// Reads a list such as `16,8,4`.
std::vector<int> integersOption(const std::string& name, const std::string& text, int low, int high) {
  std::vector<int> numbers;
  std::istringstream stream(text + ',');
  for (std::string part; std::getline(stream, part, ',');) numbers.push_back(integerOption(name, part, low, high));
  return numbers;
}

/// True rows of coarse elements are sums over fine elements, so the finest grid must subdivide all others.
void requireDivisors(const std::vector<int>& texels) {
  const int finest = *std::max_element(texels.begin(), texels.end());
  for (const int number : texels)
    if (finest % number != 0)
      usageError("--texels", std::to_string(number) + " does not divide the largest number, " + std::to_string(finest));
}

/// Reads `NAME`, or `NAME=N,N,...` with settings.
reference::TradeMethod methodOption(const std::string& text, const std::vector<reference::TradeMethod>& all) {
  const std::string name = text.substr(0, text.find('='));
  std::string names;
  for (reference::TradeMethod method : all) {
    names += (names.empty() ? "" : "|") + method.name;
    if (method.name != name) continue;
    if (name.size() == text.size()) return method;
    method.measured = integersOption("--method", text.substr(name.size() + 1), method.smallest, method.largest);
    for (const int setting : method.measured)
      if (!std::has_single_bit(static_cast<unsigned>(setting)))
        usageError("--method", std::to_string(setting) + " is not a power of two");
    std::sort(method.measured.begin(), method.measured.end());
    return method;
  }
  usageError("--method", "`" + name + "` is none of " + names);
}

std::vector<reference::TradeMethod> methodsOf(const TradeoffOptions& options) {
  const std::vector<reference::TradeMethod> all = reference::tradeMethods(options.seed);
  std::vector<reference::TradeMethod> methods;
  for (const std::string& text : options.methodTexts) methods.push_back(methodOption(text, all));
  return methods.empty() ? all : methods;
}

ordered_json settingsJson(const TradeoffOptions& options) {
  ordered_json methods;
  for (const reference::TradeMethod& method : options.methods) methods[method.name] = method.measured;
  ordered_json settings{{"texels", options.texels},
                        {"patch", options.patches},
                        {"samples", options.samples},
                        {"seed", options.seed},
                        {"residual", reference::tradeResidual},
                        {"rounds", reference::tradeRounds},
                        {"once_above_s", reference::longTime},
                        {"methods", std::move(methods)}};
  if (options.device.device != Device::Software)
    settings["device"] = deviceName(options.device.device, options.device.name);
  return settings;
}

/// Compares hemicubes and rays from the same points, at the settings of the methods. Adds a number of rays that takes
/// as long as the finest hemicube, and omits finer hemicubes, which would take most of the time. Nothing if hemicubes
/// or rays are not measured.
std::optional<reference::RowComparison> comparisonOf(const TradeoffOptions& options, const radiosity::Scene& scene,
                                                     const radiosity::Discretization& discretization) {
  reference::RowComparisonSettings settings{.hemicubes = {},
                                            .turnedHemicubes = {},
                                            .rays = {},
                                            .points = 12,
                                            .truthSamples = 1 << 9,
                                            .repeats = 3,
                                            .makeRenderer = options.makeRenderer};
  for (const reference::TradeMethod& method : options.methods)
    for (const int setting : method.measured) {
      const bool isLongest = setting > maxSamePointsResolution;
      if (method.name == "hemicube" && !isLongest) settings.hemicubes.push_back(setting);
      if (method.name == "turned-hemicube" && !isLongest) settings.turnedHemicubes.push_back(setting);
      if (method.name == "centre-rays") settings.rays.push_back(setting);
    }
  if (settings.hemicubes.empty() || settings.rays.empty()) return std::nullopt;
  if (settings.hemicubes.back() == maxSamePointsResolution && settings.rays.back() < maxSamePointsRays)
    settings.rays.push_back(maxSamePointsRays);
  return reference::compareRows(scene, discretization, settings);
}

/// Measures all choices against the truth, which has the fine grids.
Tradeoff measuredAgainst(const reference::TrueRadiosity& truth, const radiosity::Scene& scene,
                         const radiosity::Discretization& fine, const TradeoffOptions& options, Console& console) {
  const auto progress = [&console](std::size_t done, std::size_t count) {
    console.progress(static_cast<double>(done) / static_cast<double>(count),
                     "solution " + std::to_string(done + 1) + " of " + std::to_string(count));
  };
  const std::vector<reference::TradeChoice> choices =
      reference::tradeChoices(options.methods, options.texels, options.patches);
  Tradeoff tradeoff{
      scene,
      fine,
      truth,
      options.methods,
      reference::measureTradeoff(scene, fine, truth, options.methods, choices, progress, options.makeRenderer),
      reference::trueRowError(fine, truth, fine),
      comparisonOf(options, scene, fine)};
  console.endProgress();
  return tradeoff;
}

void measure(TradeoffOptions& options, Context& context) {
  Console& console = context.console;
  const reference::Stopwatch all;
  const radiosity::Scene scene = sceneOf(options.scene, console);
  requireLight(scene, options.scene.file);
  if (radiosity::brightest(scene.outside) > 0 || !scene.lamps.empty())
    throw raster::InputError("tradeoff does not measure light from outside, nor lamps that are points",
                             "omit --sky, --sun and --lamp, and the lights of a glTF file");
  const radiosity::Camera camera = cameraOf({}, scene, options.scene.file);
  Staging staging({.place = options.output, .writer = "tradeoff", .inputs = context.inputs(scene.files)});
  staging.requirePlaces({"tradeoff.csv", "tradeoff.json", "report.html"});
  const int finest = *std::max_element(options.texels.begin(), options.texels.end());
  const radiosity::Discretization fine =
      radiosity::discretize(scene, {.texels = finest, .patch = options.patches.front()});

  options.makeRenderer = rowRenderers(options.device, console);

  const reference::Stopwatch truthTime;
  console.progress(0, "true radiosity");
  const reference::TrueRadiosity truth =
      reference::trueRadiosity(scene, fine, {.samples = options.samples, .seed = options.seed});
  const double truthSeconds = truthTime.seconds();
  const Tradeoff tradeoff = measuredAgainst(truth, scene, fine, options, console);

  ordered_json result = {{"scene", options.scene.file.filename().string()}, {"settings", settingsJson(options)}};
  result.update(toJson(tradeoff));
  result["warnings"] = console.given();
  result["times"]["truth_s"] = truthSeconds;
  result["times"]["threads"] = context.threads;
  result["times"]["all_s"] = all.seconds();
  std::ostringstream csv;
  writeCsv(csv, choiceTable(result["choices"]));
  raster::writeFile(staging.folder() / "tradeoff.csv", csv.view());
  raster::writeFile(staging.folder() / "tradeoff.json", toText(result));
  raster::writeFile(staging.folder() / "report.html", tradeoffPage(tradeoff, camera, result));
  staging.commit();
  std::cout << (context.json ? toText(result) : tradeoffText(result));
}

}  // namespace

void addTradeoff(Command program, Context& context) {
  const auto options = std::make_shared<TradeoffOptions>();
  const Command command =
      program.addCommand("tradeoff", "Measure time and error of every method on a scene (takes minutes)");
  const Command what = command.under("Measurements");
  addOutput(what, options->output, "write tradeoff.json, tradeoff.csv and report.html into this folder");
  const auto readTexels = [options](const std::string& text) {
    options->texels = integersOption("--texels", text, 1, maxTexels);
    requireDivisors(options->texels);
  };
  what.addText(
      "--texels", "N,N,...",
      "divide every surface into N x N texels, for each N; all settings are measured with the first N, and the truth "
      "has the largest N (default 16,8,4)",
      readTexels);
  const auto readPatches = [options](const std::string& text) {
    options->patches = integersOption("--patch", text, 1, maxTexels);
  };
  what.addText(
      "--patch", "N,N,...",
      "let N x N elements shoot as one patch, for each N; all settings are measured with the first N (default 4,1,2,8)",
      readPatches);
  const auto readMethods = [options](const std::string& text) { options->methodTexts.push_back(text); };
  what.addTexts("--method", "NAME[=N,...]",
                "measure this method, at these resolutions or numbers of rays (repeatable; default: all methods)",
                readMethods);
  addInteger(what, "--samples", options->samples, 128, 1 << 20,
             "compute the truth with N rays per element on average (default 16384)");
  addSeed(what, options->seed);
  addRowDevice(command, options->device);
  addSceneOptions(command, options->scene);
  command.showFirst({"--output", "--method", "--texels", "--patch", "--samples", "--emit", "--reflectance", "--lights",
                     "--charts", "--two-sided"});
  command.addExamples({"data/cornell-box.obj -o tradeoff",
                       "data/cornell-box.obj -o tradeoff --texels 8 --method hemicube=128,256 --method area-rays"});
  command.onRead([options, &context] {
    options->methods = methodsOf(*options);
    context.command = [options, &context] { measure(*options, context); };
  });
}

}  // namespace hemitex::cli
