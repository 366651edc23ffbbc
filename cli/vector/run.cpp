/// `hemitex vector run` starts the program of a device for each vector and judges what it writes.
#include <atomic>
#include <csignal>
#include <memory>
#include <thread>

#include "cli/common/commands.h"
#include "cli/common/staging.h"
#include "cli/vector/judging.h"
#include "raster/base/input_error.h"
#include "raster/base/thread_group.h"
#include "reference/verdict/device_process.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using reference::DeviceFailure;
using reference::DeviceFault;

constexpr double maxSeconds = 1e6;
constexpr int maxJobs = 4096;

struct RunOptions {
  JudgingOptions judging;
  std::string device;
  fs::path output;
  double timeLimit = 10;
  int jobs = 0;  ///< 0: one per core
};

std::atomic<bool> isInterrupted{false};
std::atomic<int> interruptingSignal{0};

void interrupt(int signal) {
  interruptingSignal = signal;
  isInterrupted = true;
}

/// During its lifetime SIGINT and SIGTERM stop the programs of the device before this one ends.
class Interruption {
 public:
  Interruption() {
    std::signal(SIGINT, interrupt);
    std::signal(SIGTERM, interrupt);
    std::signal(SIGCHLD, SIG_DFL);  // a parent may have ignored it, and then no exit code arrives
  }
  ~Interruption() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
};

/// What is wrong with the item ID files of a program that ended well.
std::optional<DeviceFailure> checkFiles(const reference::TestVector& vector, const fs::path& folder,
                                        const reference::ProcessResult& process) {
  for (const reference::VectorFace& face : vector.faces) {
    const fs::path file = folder / face.ids;
    if (!fs::is_regular_file(file)) return DeviceFailure{DeviceFault::MissingFile, face.ids + " is missing", process};
    const auto width = static_cast<std::size_t>(face.face.scissor.width),
               height = static_cast<std::size_t>(face.face.scissor.height);
    const std::size_t bytes = width * height * sizeof(raster::ItemId);
    if (fs::file_size(file) != bytes)
      return DeviceFailure{
          DeviceFault::WrongSize,
          face.ids + " holds " + std::to_string(fs::file_size(file)) + " bytes instead of " + std::to_string(bytes),
          process};
  }
  return {};
}

std::optional<DeviceFailure> draw(const RunOptions& options, const std::vector<std::string>& command,
                                  const SuiteVector& vector, const fs::path& output) {
  const auto words = reference::fillCommand(command, vector.folder.string(), output.string());
  const reference::ProcessResult process = reference::runProcess(words, options.timeLimit, &isInterrupted);
  if (hasSucceeded(process)) return checkFiles(vector.vector, output, process);
  return failureOf(process);
}

/// Starts the program for each vector that is not unsupported. Returns the failures in the order of the suite.
std::vector<std::optional<DeviceFailure>> drawAll(const RunOptions& options, const Suite& suite,
                                                  const fs::path& folder) {
  const Interruption interruption;
  const std::vector<std::string> command = reference::splitCommand(options.device);
  const auto jobs = options.jobs > 0 ? static_cast<unsigned>(options.jobs) : std::thread::hardware_concurrency();
  std::vector<std::optional<DeviceFailure>> failures(suite.vectors.size());
  raster::forEachOnThreads(suite.vectors.size(), jobs, [&](std::size_t k) {
    const SuiteVector& vector = suite.vectors[k];
    if (isInterrupted || isUnsupported(vector)) return;
    const fs::path output = answerFolder(suite, vector, folder);
    fs::create_directories(output);
    failures[k] = draw(options, command, vector, output);
  });
  return failures;
}

std::vector<reference::Report> judgeAll(const JudgingOptions& options, const Suite& suite, const fs::path& folder,
                                        const std::vector<std::optional<DeviceFailure>>& failures) {
  const reference::DeviceProfile profile = profileOf(options);
  std::vector<reference::Report> reports;
  for (std::size_t k = 0; k < suite.vectors.size(); ++k) {
    const SuiteVector& vector = suite.vectors[k];
    if (failures[k])
      reports.push_back({.verdict = {vector.name, {}},
                         .errors = {},
                         .findings = {},
                         .expected = vector.expected,
                         .device = failures[k]});
    else
      reports.push_back(judgeAnswer(options, profile, vector, answerFolder(suite, vector, folder)));
  }
  return reports;
}

fs::path canonicalPath(const fs::path& folder) {
  const fs::path path = fs::weakly_canonical(folder);
  return path.has_filename() ? path : path.parent_path();
}

/// The folders of the answers are replaced, so no vector may lie in them.
void refuseToReplace(const Suite& suite, const fs::path& output) {
  for (const SuiteVector& answered : suite.vectors)
    for (const SuiteVector& vector : suite.vectors) {
      const fs::path relative =
          canonicalPath(vector.folder).lexically_relative(canonicalPath(answerFolder(suite, answered, output)));
      if (relative == "." || (!suite.isSingle && !relative.empty() && *relative.begin() != ".."))
        throw raster::InputError(output.string(), 0, "would replace the vector " + vector.folder.string(),
                                 "choose another folder");
    }
}

/// Item ID files of an earlier run that this run did not write.
void removeOldFiles(const Suite& suite, const fs::path& staged, const fs::path& output) {
  if (!suite.isSingle) return;
  for (const reference::VectorFace& face : suite.vectors[0].vector.faces)
    if (!fs::exists(staged / face.ids)) fs::remove(output / face.ids);
}

void run(const RunOptions& options, Context& context) {
  const Suite suite = readSuite(options.judging);
  refuseToReplace(suite, options.output);
  std::vector<reference::Report> reports;
  {
    Staging staging(options.output);
    const auto failures = drawAll(options, suite, staging.folder());
    if (!isInterrupted) {
      reports = judgeAll(options.judging, suite, staging.folder(), failures);
      removeOldFiles(suite, staging.folder(), options.output);
      staging.commit();
    }
  }
  if (isInterrupted) std::raise(interruptingSignal);
  writeResults(options.judging, suite, reports, context);
}

}  // namespace

void addVectorRun(Command vector, Context& context) {
  const auto options = std::make_shared<RunOptions>();
  const Command command = vector.addCommand("run", "Start a device's program for each vector and judge its item IDs");
  addJudgingOptions(command, options->judging);
  command
      .addText("--device", "COMMAND",
               "program and arguments; {vector} is the folder of the vector, {output} the folder for the item IDs",
               [options](const std::string& text) { options->device = text; })
      .required();
  addOutput(command, options->output, "folder for the item IDs; for a suite, one folder per vector");
  command.addText(
      "--time-limit", "SECONDS", "time per vector, after which the program is stopped (default 10)",
      [options](const std::string& text) { options->timeLimit = positiveOption("--time-limit", text, maxSeconds); });
  addInteger(command, "--jobs", options->jobs, 1, maxJobs, "programs at a time (default: one per core)");
  command.onRead([options, &context] { context.command = [options, &context] { run(*options, context); }; });
}

}  // namespace hemitex::cli
