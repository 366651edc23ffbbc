/// `hemitex solve`: computes the light of an OBJ scene by progressive radiosity. Writes a folder with the lit scene for
/// OBJ viewers, a picture and the numbers.
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/program.h"
#include "cli/common/staging.h"
#include "cli/common/shell_quote.h"
#include "cli/scene/sealed_folder.h"
#include "cli/solve/edits_file.h"
#include "cli/solve/options.h"
#include "cli/solve/output.h"
#include "cli/solve/places.h"
#include "cli/solve/run.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
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

/// Updates the solution for a frame and writes its folder. Returns the entry of the frame in the main solution.json.
ordered_json writeFrame(const std::filesystem::path& folder, std::size_t number, const Frame& frame,
                        radiosity::DynamicSolution& dynamic, const Showing& showing, Monitor& monitor) {
  Console& console = monitor.console();
  Laps laps;
  Convergence convergence;
  const radiosity::UpdateCost cost =
      dynamic.update(frame.edits, monitor.progressOf(showing.options.solver, convergence));
  console.endProgress();
  laps.lap("update_s");
  const std::string name = "frame-" + std::to_string(number);
  std::filesystem::create_directory(folder / name);
  const Lit lit{dynamic.scene(), dynamic.discretization(), dynamic.layout(), dynamic.solution()};
  console.warnings(lit.solution.warnings);
  console.warnings(writeSolved(folder / name, lit, shownScene(lit, showing), showing));
  laps.lap("write_s");
  ordered_json text = description(lit, showing);
  text["edits"] = frame.written;
  text["rows"] = toJson(cost);
  text["times"] = laps.times();
  text["warnings"] = lit.solution.warnings;
  text["files"] = fileHashes(folder / name);
  raster::writeFile(folder / name / "solution.json", toText(text));
  return {{"folder", name},
          {"edits", frame.written},
          {"shots", lit.solution.shots},
          {"residual", lit.solution.residual},
          {"rows", toJson(cost)},
          {"times", laps.times()}};
}

/// Prints the warnings of a solution.
void warnOf(const Solved& solved, Console& console) {
  console.warnings(solved.solution.warnings);
  if (solved.captured < 1)
    console.warning("the single plane captures " + percentText(solved.captured) +
                    " of the flux of a patch; the rest is lost, so that the scene is too dark");
}

/// Says that a signal stopped the run, and how it goes on.
void tellStop(const SolveOptions& options, int shots, Console& console) {
  const std::string file = options.longRun.checkpoint.file.string();
  console.message("a signal stopped the run after " + std::to_string(shots) + " shots; " +
                  (file.empty() ? "with --checkpoint FILE a run can go on later"
                                : "the same command with --resume " + shellQuoted(file) + " goes on"));
}

/// The files of an earlier solution in the folder that this one does not write. The page of an earlier solution would
/// show what the folder no longer holds, even if that solution.json names no files.
std::set<std::string> staleFiles(const std::filesystem::path& folder) {
  std::set<std::string> files = filesOfSolution(folder);
  files.insert("report.html");
  return files;
}

/// The part of the ranks other than 0: computes rows and writes nothing.
void computeForRankZero(SolveOptions options, Console& console) {
  options.longRun = {};
  const radiosity::Scene scene = sceneOf(options.scene, console);
  requireLight(scene, options.scene.file);
  Monitor monitor(console, options.longRun, scene, {});
  solveScene(options, scene, discretizationOf(options.discretization, scene), monitor);
}

/// What a run computes.
struct Task {
  radiosity::Scene scene;
  radiosity::Camera camera;
  std::vector<Frame> frames;  ///< of --edits
};

Task taskOf(const SolveOptions& options, Console& console) {
  Task task{.scene = sceneOf(options.scene, console), .camera = {}, .frames = {}};
  requireLight(task.scene, options.scene.file, ", or --sky 1,1,1 for light from outside");
  task.camera = cameraOf(options.camera, task.scene, options.scene.file);
  if (!options.edits.empty()) task.frames = readEdits(options.edits, task.scene, options.scene.settings);
  return task;
}

/// Writes the result, updates it for each frame, and moves it to its folder. Returns the content of solution.json.
ordered_json writeResult(const Task& task, const Outcome& outcome, Staging& staging, Monitor& monitor, Laps& laps) {
  Console& console = monitor.console();
  const SolveOptions& options = outcome.options;
  const Solved& solved = outcome.solved;
  const Lit lit{task.scene, solved.discretization, outcome.layout, solved.solution};
  const Showing showing{options, task.camera, exposureOf(options, lit)};
  std::optional<radiosity::LitScene> shown = shownScene(lit, showing);
  console.warnings(writeSolved(staging.folder(), lit, shown, showing));
  if (!options.report) shown.reset();  // textures take much memory
  const std::optional<SolveRecord> record =
      options.report ? std::optional(recordOf(lit, options, solved.convergence)) : std::nullopt;
  laps.lap("write_s");
  ordered_json text = description(lit, showing);
  text["captured"] = solved.captured;
  text["expected_error"] = orNull(outcome.expectedError);
  bool isInterrupted = solved.solution.isInterrupted;
  for (std::size_t f = 0; f < task.frames.size() && !isInterrupted; ++f) {
    text["frames"].push_back(writeFrame(staging.folder(), f + 1, task.frames[f], *outcome.dynamic, showing, monitor));
    isInterrupted = outcome.dynamic->solution().isInterrupted;
  }
  if (isInterrupted) text["interrupted"] = true;
  text["times"] = laps.times();
  text["warnings"] = console.given();
  if (record) writeReport(staging.folder(), *shown, text, *record);
  text["files"] = fileHashes(staging.folder());
  raster::writeFile(staging.folder() / "solution.json", toText(text));
  staging.commit("solution.json", staleFiles(options.output));
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
  if (!context.isWriter()) return computeForRankZero(asked, context.console);
  Console& console = context.console;
  asked.discretization.isUnburied = !asked.edits.empty();
  Laps laps;
  const Task task = taskOf(asked, console);
  laps.lap("load_s");
  Staging staging(asked.output);
  radiosity::Discretization unsplit = discretizationOf(asked.discretization, task.scene);
  staging.requirePlaces(outputNames(asked, task.scene, unsplit, task.frames.size()),
                        inputFiles(asked, task.scene, task.frames));
  Monitor monitor(console, asked.longRun, task.scene, toText(solutionSettings(asked)));
  laps.lap("discretize_s");
  const Outcome outcome = solveScene(asked, task.scene, std::move(unsplit), monitor);
  warnOf(outcome.solved, console);
  laps.lap("solve_s");
  const ordered_json text =
      writtenOrKept(asked.longRun.checkpoint.file, [&] { return writeResult(task, outcome, staging, monitor, laps); });
  if (text.contains("interrupted")) tellStop(outcome.options, outcome.solved.solution.shots, console);
  if (context.json)
    std::cout << toText(text);
  else if (console.verbosity != Verbosity::Quiet)
    std::cout << summary(text) << filesText(outcome.options);
  requireOutput("; the result in " + asked.output.string() + " is complete");
}

}  // namespace

void addSolve(Command program, Context& context) {
  const auto options = std::make_shared<SolveOptions>();
  const Command command = program.addCommand("solve", "Compute the light of a scene by progressive radiosity");
  addSolveOptions(command, *options);
  command.addExamples(
      {"data/cornell-box.obj -o lit --report", "house.obj -o lit --sky 1,1,1.2 --sun 1,3,2=4,4,3.5 --max-error 0.02"});
  command.onRead([options, command, &context] {
    completeOptions(command, *options);
    context.isShared = options->edits.empty() && !usesRays(*options);
    context.command = [options, &context] { solve(*options, context); };
  });
}

}  // namespace hemitex::cli
