/// `hemitex vector run` lets the program of a device draw each vector, and judges what it writes.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/interruption.h"
#include "cli/common/staging.h"
#include "cli/vector/judging.h"
#include "raster/base/input_error.h"
#include "raster/base/pool.h"
#include "raster/base/thread_group.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/device_process.h"
#include "reference/conformance/verdict/reduction.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using reference::ChildProcess;
using reference::DeviceFailure;
using reference::DeviceFault;

constexpr double maxSeconds = 1e6;
constexpr int maxJobs = 4096, maxRepetitions = 1000000;
/// Enough for thousands of triangles; a vector that needs tens of thousands stays larger than it must.
constexpr std::size_t maxReductionRuns = 5000;

/// The program of a device, which draws test vectors.
struct DeviceSettings {
  std::vector<std::string> command;  ///< with {vector} and {output} for a program that draws one vector
  double timeLimit = 10;             ///< seconds per vector
  bool stays = false;                ///< the program draws many vectors, one per line on its stdin (docs/backend.md)
};

struct RunOptions {
  JudgingOptions judging;
  DeviceSettings device;
  fs::path output;
  int jobs = 0;  ///< 0: one per core
  int repetitions = 1;
};

/// A new empty folder for temporary files.
class ScratchFolder {
 public:
  ScratchFolder() {
    if (!mkdtemp(name_.data())) throw raster::InputError(name_, 0, "a temporary folder cannot be made");
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(name_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  fs::path path() const { return name_; }

 private:
  std::string name_ = (fs::temp_directory_path() / "hemitex-XXXXXX").string();
};

bool isAnswer(const std::string& line) { return line == "done" || line.starts_with("failed"); }

/// The line that asks a program that stays for a vector.
std::string requestFor(const fs::path& folder, const fs::path& output) {
  for (const fs::path& path : {folder, output})
    if (path.string().find_first_of("\t\n") != std::string::npos)
      throw raster::InputError(path.string(), 0, "has a tab or a line end in its name",
                               "choose another folder, because a line names it to the program");
  return folder.string() + '\t' + output.string();
}

/// What is wrong with the item ID files of a program that ended well.
std::optional<DeviceFailure> checkFiles(const reference::TestVector& vector, const fs::path& folder,
                                        const reference::ProcessResult& process) {
  const bool arePairs = reference::sourceOf(vector).value == raster::PixelValue::Pairs;
  for (const reference::VectorFace& face : vector.faces) {
    const fs::path file = folder / face.ids;
    if (!fs::is_regular_file(fs::symlink_status(file)))
      return DeviceFailure{DeviceFault::MissingFile, face.ids + " is missing", process};
    const auto width = static_cast<std::size_t>(face.face.scissor.width),
               height = static_cast<std::size_t>(face.face.scissor.height);
    const std::size_t bytes = width * height * (arePairs ? sizeof(std::uint64_t) : sizeof(raster::ItemId));
    if (fs::file_size(file) != bytes)
      return DeviceFailure{
          DeviceFault::WrongSize,
          face.ids + " holds " + std::to_string(fs::file_size(file)) + " bytes instead of " + std::to_string(bytes),
          process};
  }
  return {};
}

class DeviceProgram {
 public:
  explicit DeviceProgram(DeviceSettings settings) : settings_(std::move(settings)) {}

  /// Lets the program draw the vector in `folder`. It writes its item ID files into `output`, an empty folder that this
  /// function makes. Returns why there are none. A LongRun that stops ends the program. Several threads may call it at
  /// a time; a program that stays then runs as many times. Throws InputError if the program cannot be started.
  std::optional<DeviceFailure> draw(const reference::TestVector& vector, const fs::path& folder,
                                    const fs::path& output) {
    fs::create_directories(output);
    if (settings_.stays) {
      std::optional<DeviceFailure> failure;
      processes_.with([&](Process& process) { failure = ask(process, vector, folder, output); });
      return failure;
    }
    const auto words = reference::fillCommand(settings_.command, folder.string(), output.string());
    const reference::ProcessResult process = reference::runProcess(words, settings_.timeLimit, &LongRun::isStopping());
    if (process.hasSucceeded()) return checkFiles(vector, output, process);
    return failureOf(process);
  }

 private:
  using Process = std::unique_ptr<reference::ChildProcess>;

  std::optional<DeviceFailure> ask(Process& process, const reference::TestVector& vector, const fs::path& folder,
                                   const fs::path& output) const {
    const std::string request = requestFor(folder, output);
    if (!process) process = std::make_unique<ChildProcess>(settings_.command, ChildProcess::Talk::Lines);
    const auto answer = process->ask(request, isAnswer, settings_.timeLimit, &LongRun::isStopping());
    if (!answer) {
      const reference::ProcessResult end = process->finish(0);
      process.reset();
      return failureOf(end);
    }
    const reference::ProcessResult running{.lastLines = process->lastLines()};
    if (*answer != "done") return DeviceFailure{DeviceFault::Refused, *answer, running};
    return checkFiles(vector, output, running);
  }

  DeviceSettings settings_;
  raster::Pool<Process> processes_;  ///< that stay; null before the start and after a failure
};

/// What a device did with a vector.
struct Drawing {
  std::optional<DeviceFailure> failure;
  std::optional<reference::Repetition> repetition;  ///< of more than one run
};

/// The first run writes into `output`.
Drawing drawRepeatedly(DeviceProgram& device, int repetitions, const SuiteVector& vector, const fs::path& output) {
  Drawing drawing{device.draw(vector.vector, vector.folder, output), {}};
  if (repetitions == 1 || drawing.failure) return drawing;
  reference::RepeatedRuns runs(vector.vector);
  runs.add(reference::readCandidate(output, vector.vector));
  for (int run = 2; run <= repetitions && !LongRun::isStopping(); ++run) {
    const ScratchFolder scratch;
    drawing.failure = device.draw(vector.vector, vector.folder, scratch.path());
    if (drawing.failure) {
      drawing.failure->message += ", in run " + std::to_string(run) + " of " + std::to_string(repetitions);
      return drawing;
    }
    runs.add(reference::readCandidate(scratch.path(), vector.vector));
  }
  drawing.repetition = runs.result();
  return drawing;
}

/// Draws each vector that is not unsupported. The results have the order of the suite.
std::vector<Drawing> drawAll(const RunOptions& options, DeviceProgram& device, const Suite& suite,
                             const fs::path& folder) {
  const auto jobs = options.jobs > 0 ? static_cast<unsigned>(options.jobs) : std::thread::hardware_concurrency();
  std::vector<Drawing> drawings(suite.vectors.size());
  raster::forEachOnThreads(suite.vectors.size(), jobs, [&](std::size_t k) {
    const SuiteVector& vector = suite.vectors[k];
    if (LongRun::isStopping() || isUnsupported(vector)) return;
    drawings[k] = drawRepeatedly(device, options.repetitions, vector, answerFolder(suite, vector, folder));
  });
  return drawings;
}

reference::Report reportOn(const JudgingOptions& options, const reference::DeviceProfile& profile,
                           const SuiteVector& vector, const fs::path& answer, const Drawing& drawing) {
  reference::Report report{{vector.name, {}}, {}, {}};
  if (drawing.failure)
    report.expected = vector.expected;
  else
    report = judgeAnswer(options, profile, vector, answer);
  report.device = drawing.failure;
  report.repetition = drawing.repetition;
  return report;
}

std::vector<reference::Report> judgeAll(const JudgingOptions& options, const Suite& suite, const fs::path& folder,
                                        const std::vector<Drawing>& drawings) {
  const reference::DeviceProfile profile = profileOf(options);
  return makeAll<reference::Report>(suite.vectors.size(), [&](std::size_t k) {
    const SuiteVector& vector = suite.vectors[k];
    return reportOn(options, profile, vector, answerFolder(suite, vector, folder), drawings[k]);
  });
}

/// The answer of the device to a vector that is not in a folder yet.
struct Answer {
  std::optional<DeviceFailure> failure;
  std::vector<raster::ItemBuffer> found;
};

Answer answerTo(DeviceProgram& device, const reference::TestVector& vector) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.path() / "vector");
  reference::writeVector(scratch.path() / "vector", vector, {});
  Answer answer{device.draw(vector, scratch.path() / "vector", scratch.path() / "output"), {}};
  if (!answer.failure) answer.found = reference::readCandidate(scratch.path() / "output", vector);
  return answer;
}

/// Whether the device fails in the same way: to draw, or with errors of any kind.
bool failsAlike(const Answer& answer, const reference::TestVector& vector, const reference::Report& report,
                const reference::DeviceProfile& profile) {
  if (report.device || answer.failure)
    return report.device && answer.failure && answer.failure->fault == report.device->fault;
  return hasErrors(judge(vector, answer.found, profile));
}

/// The vector as small as the device still fails on it.
SmallFailure minimizeOnDevice(DeviceProgram& device, const reference::DeviceProfile& profile, const SuiteVector& vector,
                              const reference::Report& report) {
  const auto fails = [&](const reference::TestVector& smaller) {
    if (LongRun::isStopping() || smaller.list.indices.empty()) return false;
    return failsAlike(answerTo(device, smaller), smaller, report, profile);
  };
  const reference::TestVector smallest = reference::reduce(vector.vector, fails, maxReductionRuns);
  return {smallest, reference::render(smallest), answerTo(device, smallest).found};
}

fs::path canonicalPath(const fs::path& folder) {
  const fs::path path = fs::weakly_canonical(folder);
  return path.has_filename() ? path : path.parent_path();
}

/// Item ID files in the folders of the answers are replaced, so no vector may lie in them.
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

/// The item ID files of an earlier run that this run did not write, relative to `output`.
std::set<std::string> filesToRemove(const Suite& suite, const fs::path& output) {
  std::set<std::string> files;
  for (const SuiteVector& vector : suite.vectors)
    for (const reference::VectorFace& face : vector.vector.faces)
      files.insert((answerFolder(suite, vector, output) / face.ids).lexically_relative(output).string());
  return files;
}

void run(const RunOptions& options, Context& context) {
  const Suite suite = readSuite(options.judging);
  refuseToReplace(suite, options.output);
  JudgingFiles files(options.judging, context);
  const LongRun stopsPrograms;
  DeviceProgram device(options.device);
  std::signal(SIGCHLD, SIG_DFL);  // a parent may have ignored it, and then no exit code arrives
  std::vector<reference::Report> reports;
  {
    Staging staging({.place = options.output, .writer = "vector run", .inputs = context.inputs()});
    const std::vector<Drawing> drawings = drawAll(options, device, suite, staging.folder());
    if (!LongRun::isStopping()) {
      reports = judgeAll(options.judging, suite, staging.folder(), drawings);
      reference::nameStaleFrames(reports);
      staging.commit({}, filesToRemove(suite, options.output));
    }
  }
  if (LongRun::isStopping()) return;
  const auto minimize = [&](const SuiteVector& vector, const reference::Report& report) {
    return minimizeOnDevice(device, profileOf(options.judging), vector, report);
  };
  writeResults(options.judging, files, suite, reports, minimize, context);
}

}  // namespace

void addVectorRun(Command vector, Context& context) {
  const auto options = std::make_shared<RunOptions>();
  const Command command =
      vector.addCommand("run", "Let the program of a device draw each vector, and judge its item IDs");
  const Command device = command.under("Device");
  device
      .addText("--device", "COMMAND",
               "program and arguments; {vector} is the folder of the vector, {output} the folder for the item IDs",
               [options](const std::string& text) { options->device.command = reference::splitCommand(text); })
      .required();
  addOutput(device, options->output, "folder for the item IDs; for a suite, one folder per vector");
  device.addFlag("--lines", options->device.stays,
                 "the program draws many vectors: each line on its stdin names {vector} and {output}, separated by a "
                 "tab, and it answers done, or failed and a reason");
  device.addText("--time-limit", "SECONDS", "time per vector, after which the program is stopped (default 10)",
                 [options](const std::string& text) {
                   options->device.timeLimit = positiveOption("--time-limit", text, maxSeconds);
                 });
  addInteger(device, "--jobs", options->jobs, 1, maxJobs, "programs at a time (default: one per core)");
  addInteger(device, "--repeat", options->repetitions, 1, maxRepetitions,
             "draw each vector N times; it fails if its item IDs are not always the same (default 1)");
  addJudgingOptions(command, options->judging);
  command.showFirst({"--device", "--output", "--lines", "--time-limit", "--jobs", "--profile", "--expectations",
                     "--shard", "--junit", "--html"});
  command.addExamples({"suite --device './draw {vector} {output}' -o drawn",
                       "suite --device ./serve --lines -o drawn --repeat 3 --html results.html"});
  command.onRead([options, &context] {
    const auto names = [](const std::string& word) {
      return word.find("{vector}") != std::string::npos || word.find("{output}") != std::string::npos;
    };
    if (options->device.stays && std::ranges::any_of(options->device.command, names))
      usageError("--lines", "the program reads {vector} and {output} from its stdin; leave them out of the command");
    context.command = [options, &context] { run(*options, context); };
  });
}

}  // namespace hemitex::cli
