/// `hemitex watch`: solves a scene, and updates the solution whenever its files are saved. The page in the browser
/// follows.
///
/// There is no server. The page loads the small script watch.js from its own folder again and again, which browsers
/// allow for a page from disk. The script names the version of the page that the folder holds; a page of another
/// version loads itself again. So no port is opened, and other programs cannot ask for the scene.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/interruption.h"
#include "cli/common/json.h"
#include "cli/common/numbers.h"
#include "cli/common/staging.h"
#include "cli/report/solved_page.h"
#include "cli/scene/sealed_folder.h"
#include "cli/solve/options.h"
#include "cli/solve/output.h"
#include "cli/solve/run.h"
#include "cli/view/browser.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/solver/dynamic_solution.h"
#include "radiosity/textures/lit_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"
#include "reference/base/stopwatch.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

const char* const scriptName = "watch.js";
const char* const pageName = "report.html";

struct WatchOptions {
  SolveOptions solve;
  bool view = false;
};

bool isStopping() { return LongRun::isStopping(); }

/// The time of the last change and the size of files at one time. A file may be missing; it changes when it appears.
using FileStates = std::map<fs::path, std::pair<fs::file_time_type, std::uintmax_t>>;

void lookAt(FileStates& files) {
  for (auto& [file, state] : files) {
    std::error_code isMissing;
    state.first = fs::last_write_time(file, isMissing);
    state.second = fs::file_size(file, isMissing);
    if (isMissing) state = {};
  }
}

/// Waits until a file has changed and none has changed for 40 ms since, so that a program has probably written all of
/// them. Returns a changed file; nothing after a signal.
std::optional<fs::path> awaitChange(const FileStates& before) {
  constexpr std::chrono::milliseconds interval{20};
  constexpr int quietIntervals = 2;
  FileStates now = before;
  int quiet = 0;
  while (!isStopping()) {
    std::this_thread::sleep_for(interval);
    const FileStates last = now;
    lookAt(now);
    quiet = now == last ? quiet + 1 : 0;
    if (quiet < quietIntervals) continue;
    for (const auto& [file, state] : now)
      if (state != before.at(file)) return file;
  }
  return std::nullopt;
}

/// What a change of the files led to.
struct Round {
  bool isUpdate = false;  ///< else a new solution
  int shots = 0;
  double solveSeconds = 0, writeSeconds = 0;
};

ordered_json toJson(const Round& round) {
  return {{"updated", round.isUpdate},
          {"shots", round.shots},
          {"times", {{"solve_s", round.solveSeconds}, {"write_s", round.writeSeconds}}}};
}

std::string textOf(const Round& round) {
  return std::string(round.isUpdate ? "updated" : "solved") + " in " + roundedText(round.solveSeconds) + " s with " +
         std::to_string(round.shots) + " shots, written in " + roundedText(round.writeSeconds) + " s";
}

/// The solution of the files as they were read last.
class WatchedSolution {
 public:
  /// `inputs` are the files of the command line.
  WatchedSolution(const SolveOptions& asked, const std::set<fs::path>& inputs, Console& console)
      : asked_(asked), options_(asked), inputs_(inputs), console_(console) {}

  /// The files that were read, or that could be, as they were then.
  const FileStates& files() const { return files_; }

  /// Reads the scene and updates the folder. Throws InputError if the scene is at fault; then the folder stays as it
  /// was. Writes nothing after a signal.
  Round follow() {
    watchFiles({asked_.scene.file, viewFileOf(asked_.scene.file)});  // in case that the scene cannot be read
    radiosity::Scene scene = loadedScene(asked_);
    watchFiles(scene.files);
    tellNew(scene.warnings);
    requireLight(scene, asked_.scene.file, ", or --sky 1,1,1 for light from outside");
    camera_ = cameraOf(asked_.camera, scene, asked_.scene.file);
    Round round;
    reference::Stopwatch watch;
    std::optional<radiosity::EditedScene> edit;
    if (dynamic_) edit = radiosity::readAgain(dynamic_->scene(), scene);
    round.isUpdate = edit.has_value();
    if (edit)
      update(std::move(*edit));
    else
      solve(std::move(scene));
    round.solveSeconds = watch.seconds();
    watch = {};
    if (!isStopping()) write(round);
    round.writeSeconds = watch.seconds();
    round.shots = dynamic_->solution().shots;
    return round;
  }

  /// Writes watch.js: the state (`shown`, `solving`, `failed` or `ended`), and what is wrong with the scene.
  void tell(const std::string& state, const std::string& problem = "") const {
    const ordered_json news = {{"version", version_}, {"state", state}, {"problem", problem}};
    Staging staging({Output::Kind::File, asked_.output / scriptName, "watch", {}});
    raster::writeFile(staging.file(), "hemitexWatch(" + toText(news) + ");\n");
    staging.commit();
  }

 private:
  /// Adds files, and looks at all.
  void watchFiles(const std::vector<fs::path>& files) {
    for (const fs::path& file : files) files_[file];
    lookAt(files_);
  }

  void tellNew(const std::vector<std::string>& warnings) {
    const std::vector<std::string> given = console_.given();
    for (const std::string& warning : warnings)
      if (std::find(given.begin(), given.end(), warning) == given.end()) console_.warning(warning);
  }

  void update(radiosity::EditedScene edit) {
    convergence_ = {};
    Monitor monitor(console_, {}, dynamic_->scene(), {});
    dynamic_->updateTo(std::move(edit), monitor.progressOf(options_.solver, convergence_));
    console_.endProgress();
  }

  void solve(radiosity::Scene scene) {
    SolveOptions options = asked_;
    if (options.residual) options.solver.residual = *options.residual;
    requireMemoryOfRun(scene, options);
    radiosity::Discretization unsplit = discretizationOf(options.discretization, scene);
    Staging(output()).requirePlaces(outputNames(options, scene, unsplit, 0));
    Monitor monitor(console_, {}, scene, {});
    SolveResult result = solveScene(options, scene, camera_, std::move(unsplit), monitor);
    options_ = result.options;
    convergence_ = std::move(result.convergence);
    dynamic_ = radiosity::editable(std::move(scene), std::move(result.light), hooksOf(options_, errors_));
  }

  Output output() const {
    Output output{.place = asked_.output, .writer = solveWriter, .inputs = inputs_};
    for (const auto& [file, state] : files_) output.inputs.insert(file);
    return output;
  }

  /// Writes the folder. All updates of a solution are shown with its exposure, so that brighter light looks brighter.
  void write(const Round& round) {
    const SolvedScene solved{
        options_, camera_, dynamic_->scene(), dynamic_->discretization(), dynamic_->layout(), dynamic_->solution()};
    options_.camera.exposure = exposureOf(solved);
    std::optional<radiosity::LitScene> lit = litScene(solved);
    Staging staging(output());
    tellNew(writeSolved(staging.folder(), solved, lit));
    tellNew(warningsOf(solved.solution));
    ordered_json text = description(solved, lit);
    text["captured"] = nullptr;
    text["expected_error"] = nullptr;
    text["expected_error_seen"] = nullptr;
    text["times"] = {{"solve_s", round.solveSeconds}};
    text["warnings"] = solved.scene.warnings;
    std::vector<std::uint32_t> surfaces(solved.scene.surfaces.size());
    std::iota(surfaces.begin(), surfaces.end(), 0U);
    const fs::path glb = staging.folder() / "scene.glb";
    version_ = reference::sha256(toText(text["settings"]) + (fs::exists(glb) ? reference::sha256OfFile(glb) : ""));
    raster::writeFile(
        staging.folder() / pageName,
        solvedPage({.glb = glb, .scene = std::move(lit->scene), .surfaceOf = surfaces, .version = version_}, text));
    text["files"] = fileHashes(staging);
    raster::writeFile(staging.folder() / solutionName, toText(text));
    staging.commit(solutionName, staging.earlierFiles());
    tell("shown");
  }

  SolveOptions asked_, options_;  ///< as given; and with chosen settings and the exposure of the last new solution
  std::set<fs::path> inputs_;
  Console& console_;
  FileStates files_;
  std::string version_;
  radiosity::Camera camera_;
  Convergence convergence_;
  reference::RowErrors errors_ = std::make_shared<std::vector<double>>();
  std::optional<radiosity::DynamicSolution> dynamic_;
};

void print(const Round& round, const std::string& reason, const Context& context) {
  if (context.json) {
    ordered_json line = {{"changed", reason}};
    line.update(toJson(round));
    std::cout << toLine(line) << std::endl;
  } else if (context.console.verbosity != Verbosity::Quiet) {
    std::cout << (reason.empty() ? "" : reason + " changed: ") << textOf(round) << std::endl;
  }
}

/// Follows the files after a change; prints a fault of the scene, which the next change may repair.
void followChange(WatchedSolution& solution, const fs::path& changed, Context& context) {
  solution.tell("solving");
  try {
    const Round round = solution.follow();
    if (!isStopping()) print(round, changed.filename().string(), context);
  } catch (const raster::InputError& error) {
    context.console.error(error.what());
    solution.tell("failed", error.what());
  }
}

/// Throws a usage error for options that updates, or the page, do not allow.
void requireUpdatable(Command command) {
  for (const char* name :
       {"--edits", "--adaptive", "--checkpoint", "--resume", "--every", "--progress", "--no-textures", "--matrix"})
    if (command.isGiven(name)) usageError(name, "is not used by `hemitex watch`; omit it");
}

void watch(const WatchOptions& options, Context& context) {
  const LongRun untilSignal;
  std::vector<std::string> warnings;
  SolveOptions asked = withStatedUnit(options.solve, warnings);
  asked.makeRenderer = rowRenderers(asked.device, context.console);
  WatchedSolution solution(asked, context.inputs(), context.console);
  context.console.warnings(warnings);
  const Round first = solution.follow();
  if (isStopping()) return;
  print(first, "", context);
  const fs::path page = options.solve.output / pageName;
  if (options.view) openInBrowser(page, context.console);
  context.console.message("the page is " + page.string() + "; waiting for changes, Ctrl-C ends");
  while (const std::optional<fs::path> changed = awaitChange(solution.files())) {
    followChange(solution, *changed, context);
    if (isStopping()) break;
  }
  solution.tell("ended");
}

}  // namespace

void addWatch(Command program, Context& context) {
  const auto options = std::make_shared<WatchOptions>();
  const Command command =
      program.addCommand("watch", "Solve a scene again whenever it is saved, and show it in the browser");
  addSolveOptions(command, options->solve, context);
  command.under("Output").addFlag("--view", options->view, "open the page in the browser ($BROWSER, else xdg-open)");
  command.addExamples({"house.obj -o lit --view", "data/furnished-room.obj -o lit --view --residual 0.01"});
  command.onRead([options, command, &context] {
    completeOptions(command, options->solve);
    requireUpdatable(command);
    options->solve.isContinued = true;
    options->solve.discretization.isUnburied = true;
    context.command = [options, &context] { watch(*options, context); };
  });
}

}  // namespace hemitex::cli
