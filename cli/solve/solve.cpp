/// `hemitex solve`: computes the light of an OBJ scene by progressive radiosity. Writes a folder with the lit scene for
/// OBJ viewers, a picture and the numbers.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/program.h"
#include "cli/common/staging.h"
#include "cli/scene/sealed_folder.h"
#include "cli/solve/bands_file.h"
#include "cli/solve/edits_file.h"
#include "cli/solve/options.h"
#include "cli/solve/output.h"
#include "cli/solve/run.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/gather/final_gather.h"
#include "radiosity/solver/dynamic_solution.h"
#include "radiosity/textures/lit_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"
#include "reference/base/stopwatch.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

/// Seconds of the parts of a run.
class Laps {
 public:
  /// Stores the time since the last lap under `name`.
  void lap(const std::string& name) {
    times_[name] = watch_.seconds();
    watch_ = reference::Stopwatch();
  }
  const ordered_json& times() const { return times_; }

 private:
  reference::Stopwatch watch_;
  ordered_json times_;
};

ordered_json toJson(const radiosity::UpdateCost& cost) {
  return {{"in_windows", cost.rowsInWindows},
          {"whole", cost.rowsWhole},
          {"taken_back", cost.rowsRetracted},
          {"left", cost.rowsLeft},
          {"started_over", cost.startedOver}};
}

/// Updates the solution for a frame and writes its folder, with the options and camera of `first`. Returns the entry of
/// the frame in the main solution.json.
ordered_json writeFrame(const std::filesystem::path& folder, std::size_t number, const Frame& frame,
                        radiosity::DynamicSolution& dynamic, const SolvedScene& first, Monitor& monitor) {
  Console& console = monitor.console();
  Laps laps;
  Convergence convergence;
  const std::optional<radiosity::Snapshot> snapshot = monitor.begin();
  const radiosity::UpdateCost cost = dynamic.update(frame.edits, monitor.progressOf(first.options.solver, convergence),
                                                    snapshot ? &*snapshot : nullptr);
  console.endProgress();
  laps.lap("update_s");
  const std::string name = "frame-" + std::to_string(number);
  std::filesystem::create_directory(folder / name);
  SolvedScene solved{first.options,    first.camera,      dynamic.scene(), dynamic.discretization(),
                     dynamic.layout(), dynamic.solution()};
  const std::optional<radiosity::GatheredLight> gathered = gatheredLight(solved, console);
  if (gathered) solved.gathered = &*gathered;
  const std::optional<radiosity::LitScene> lit = litScene(solved);
  console.warnings(warningsOf(solved.solution));
  console.warnings(writeSolved(folder / name, solved, lit));
  laps.lap("write_s");
  ordered_json text = description(solved, lit);
  text["edits"] = frame.written;
  text["rows"] = toJson(cost);
  text["times"] = laps.times();
  text["warnings"] = warningsOf(solved.solution);
  text["files"] = fileHashes(folder / name);
  raster::writeFile(folder / name / solutionName, toText(text));
  ordered_json entry = {{"folder", name},
                        {"edits", frame.written},
                        {"shots", solved.solution.shots},
                        {"residual", solved.solution.residual},
                        {"ended_by", text["ended_by"]},
                        {"rows", toJson(cost)},
                        {"times", laps.times()}};
  if (text.contains("interrupted")) entry["interrupted"] = true;
  return entry;
}

/// Prints the warnings of a solution.
void warnOf(const SolveResult& result, Console& console) {
  console.warnings(warningsOf(result.light.solution));
  const radiosity::LightSettings& settings = result.light.settings;
  const std::optional<radiosity::LightErrors>& errors = result.light.expectedErrors;
  const bool isWithin = errors && settings.maxError && errors->larger() <= *settings.maxError;
  if (settings.maxError && !isWithin && !result.light.solution.isInterrupted)
    console.warning("--shots ended the solution before its error was known to be within --max-error");
  if (result.light.captured < 1)
    console.warning("the single plane captures " + percentText(result.light.captured) +
                    " of the flux of a patch; the rest is lost, so that the scene is too dark");
}

/// Says that a signal stopped the run, and how it goes on.
void tellStop(const SolveOptions& options, int shots, Console& console) {
  const std::string file = options.longRun.checkpoint.string();
  console.message("a signal stopped the run after " + std::to_string(shots) + " shots" +
                  (options.gather ? ", before all texels had gathered their light; " : "; ") +
                  (file.empty() ? "with --checkpoint FILE a run can go on later"
                                : "the same command with --resume " + shellQuoted(file) + " goes on"));
}

/// All files that were read: those of the command line, the scene with its materials and images, the camera, and what
/// edits add.
std::set<std::filesystem::path> inputFiles(const SolveOptions& options, const Context& context,
                                           const radiosity::Scene& scene, const std::vector<Frame>& frames) {
  std::set<std::filesystem::path> files = context.inputs(scene.files);
  for (const Frame& frame : frames) files.insert(frame.files.begin(), frame.files.end());
  files.insert(viewFileOf(options.scene.file));
  return files;
}

/// What a checkpoint belongs to, beside the scene: equal for equal settings and edits. The camera is part of it if the
/// effort follows what it sees.
std::string textOfRun(const SolveOptions& options, const radiosity::Scene& scene, const radiosity::Camera& camera,
                      const std::vector<Frame>& frames) {
  std::string text = toText(solutionSettings(options));
  if (followsCamera(options))
    text += toText(ordered_json{cli::toJson(camera), options.camera.width, options.camera.height});
  std::set<std::filesystem::path> added;
  for (const Frame& frame : frames) {
    text += toText(frame.written);
    added.insert(frame.files.begin(), frame.files.end());
  }
  for (const std::filesystem::path& file : scene.files) added.erase(file);
  for (const std::filesystem::path& file : added) text += reference::sha256OfFile(file);
  return text;
}

/// The scene of the options, and its warnings told.
radiosity::Scene sceneOf(const SolveOptions& options, Console& console) {
  radiosity::Scene scene = loadedScene(options);
  console.warnings(scene.warnings);
  // Objects that move uncover what they stand on.
  return writesFacets(options) ? radiosity::withoutBuried(std::move(scene)) : scene;
}

/// The part of the ranks other than 0: computes rows and writes nothing.
void computeForRankZero(SolveOptions options, Console& console) {
  options.longRun = {};
  const radiosity::Scene scene = sceneOf(options, console);
  requireLight(scene, options.scene.file);
  Monitor monitor(console, options.longRun, scene, {});
  const radiosity::Camera camera = cameraOf(options.camera, scene, options.scene.file);
  solveScene(options, scene, camera, discretizationOf(options.discretization, scene), monitor);
}

/// Updates the solution of the result, which `first` shows, for each frame and writes their folders. Adds the entries
/// of the frames to `text`, and says there if a signal ended the last one.
void writeFrames(const std::filesystem::path& folder, const std::vector<Frame>& frames, const SolvedScene& first,
                 SolveResult& result, Monitor& monitor, ordered_json& text) {
  const auto errors = std::make_shared<std::vector<double>>();
  radiosity::DynamicSolution dynamic =
      radiosity::editable(first.scene, std::move(result.light), hooksOf(result.options, errors));
  for (std::size_t f = 0; f < frames.size() && !text.contains("interrupted"); ++f) {
    text["frames"].push_back(writeFrame(folder, f + 1, frames[f], dynamic, first, monitor));
    if (text["frames"].back().contains("interrupted")) text["interrupted"] = true;
  }
}

/// Writes the result, updates it for each frame, and moves it to its folder. Returns the content of solution.json.
ordered_json writeResult(const radiosity::Scene& scene, const radiosity::Camera& camera,
                         const std::vector<Frame>& frames, SolveResult& result, Staging& staging, Monitor& monitor,
                         Laps& laps) {
  Console& console = monitor.console();
  SolveOptions& options = result.options;
  SolvedScene solved{
      options,         camera, scene, result.light.discretization, result.light.layout, result.light.solution,
      result.rowErrors};
  const std::optional<radiosity::GatheredLight> gathered = gatheredLight(solved, console);
  if (gathered) solved.gathered = &*gathered;
  console.warnings(unitWarning(solved));
  options.camera.exposure = exposureOf(solved);  // also that of all frames
  std::optional<radiosity::LitScene> lit = litScene(solved);
  console.warnings(writeSolved(staging.folder(), solved, lit));
  ordered_json text = description(solved, lit);
  std::optional<ShownScene> shown;
  if (options.report)
    shown = shownScene(staging.folder(), solved, lit ? std::move(lit->scene) : scene, result.convergence);
  lit.reset();  // textures take much memory
  laps.lap("write_s");
  text["captured"] = result.light.captured;
  const std::optional<radiosity::LightErrors>& errors = result.light.expectedErrors;
  text["expected_error"] = errors ? ordered_json(errors->all) : ordered_json();
  text["expected_error_seen"] = errors ? ordered_json(errors->seen) : ordered_json();
  if (!result.rowErrors.empty())
    text["row_error"] = *std::max_element(result.rowErrors.begin(), result.rowErrors.end());
  if (!frames.empty() && !text.contains("interrupted"))
    writeFrames(staging.folder(), frames, solved, result, monitor, text);
  text["times"] = laps.times();
  text["warnings"] = console.given();
  if (shown) raster::writeFile(staging.folder() / "report.html", solvedPage(*shown, text));
  text["files"] = fileHashes(staging);
  raster::writeFile(staging.folder() / solutionName, toText(text));
  staging.commit(solutionName, staging.earlierFiles());
  return text;
}

/// Calls write(). If it fails, the message says that the light is not lost.
template <typename Write>
ordered_json writtenOrKept(const std::filesystem::path& checkpoint, const Write& write) {
  if (checkpoint.empty()) return write();
  const auto kept = [&](const std::exception& error) {
    return raster::InputError(std::string(error.what()) + "; the light is in the checkpoint",
                              "the same command with --resume " + shellQuoted(checkpoint.string()) + " writes it");
  };
  try {
    return write();
  } catch (const raster::InputError& error) {
    throw kept(error);
  } catch (const std::filesystem::filesystem_error& error) {
    throw kept(error);
  }
}

void solve(SolveOptions asked, Context& context) {
  asked.ranks = context.ranks.get();
  Console& console = context.console;
  std::vector<std::string> warnings;
  asked = withStatedUnit(std::move(asked), warnings);
  console.warnings(warnings);
  asked.makeRenderer = rowRenderers(asked.device, console);
  if (!context.isWriter()) return computeForRankZero(asked, console);
  if (asked.isContinued) asked.discretization.isUnburied = true;
  Laps laps;
  const radiosity::Scene scene = sceneOf(asked, console);
  if (asked.residual) asked.solver.residual = *asked.residual;
  requireLight(scene, asked.scene.file, ", or --sky 1,1,1 for light from outside");
  const radiosity::Camera camera = cameraOf(asked.camera, scene, asked.scene.file);
  const std::vector<Frame> frames =
      asked.edits.empty() ? std::vector<Frame>() : readEdits(asked.edits, scene, asked.scene.settings);
  if (!asked.matrix.empty()) requireSamePlaces(frames, asked.edits);
  laps.lap("load_s");
  requireMemoryOfRun(scene, asked);
  const std::set<std::filesystem::path> inputs = inputFiles(asked, context, scene, frames);
  Staging staging({.place = asked.output, .writer = solveWriter, .inputs = inputs});
  radiosity::Discretization unsplit = discretizationOf(asked.discretization, scene);
  staging.requirePlaces(outputNames(asked, scene, unsplit, frames.size()));
  Monitor monitor(console, asked.longRun, scene, textOfRun(asked, scene, camera, frames), inputs);
  laps.lap("discretize_s");
  SolveResult result = solveScene(asked, scene, camera, std::move(unsplit), monitor);
  warnOf(result, console);
  laps.lap("solve_s");
  const int shots = result.light.solution.shots;
  const ordered_json text = writtenOrKept(
      asked.longRun.checkpoint, [&] { return writeResult(scene, camera, frames, result, staging, monitor, laps); });
  if (text.contains("interrupted")) tellStop(result.options, shots, console);
  if (context.json)
    std::cout << toText(text);
  else if (console.verbosity != Verbosity::Quiet)
    std::cout << summary(text) << filesText(result.options);
  requireOutput("; the result in " + asked.output.string() + " is complete");
}

}  // namespace

void addSolve(Command program, Context& context) {
  const auto options = std::make_shared<SolveOptions>();
  const Command command = program.addCommand("solve", "Compute the light of a scene by progressive radiosity");
  addSolveOptions(command, *options, context);
  command.addExamples(
      {"data/cornell-box.obj -o lit --report", "house.obj -o lit --sky 1,1,1.2 --sun 1,3,2=4,4,3.5 --max-error 0.02"});
  command.onRead([options, command, &context] {
    completeOptions(command, *options);
    context.isShared = options->edits.empty() && usesDrawnRows(*options);
    context.command = [options, &context] { solve(*options, context); };
  });
}

}  // namespace hemitex::cli
