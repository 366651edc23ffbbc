#include "cli/common/program.h"

#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <boost/algorithm/string.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>

#include "cli/common/interruption.h"
#include "cli/common/numbers.h"
#include "cli/common/staging.h"
#include "cli/help/command_tree.h"
#include "cli/help/shell_files.h"
#include "radiosity/ranks/messenger.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"
#include "raster/base/parallel.h"

namespace hemitex::cli {
namespace {

constexpr int comparisonFailed = 1;
constexpr int badInput = 2;
constexpr int ourFault = 3;
constexpr int closedPipe = 128 + SIGPIPE;  // as of a program that the signal ends
constexpr int maxThreads = 4096;

/// The reader of the standard output, such as `head`, wants no more of it. Thrown and caught in this file.
struct ClosedPipe {};

bool isClosedPipe(int file) {
  pollfd asked{file, POLLOUT, 0};
  return poll(&asked, 1, 0) == 1 && (asked.revents & POLLERR) != 0;
}

std::string adviceOf(const Program& program) {
  return "Run `" + program.name + " --help` or `" + program.name + " COMMAND --help` for the options.";
}

/// Says which arguments and options the command needs that are not given; arguments come first. Empty if none.
std::string missingArguments(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  std::vector<std::string> names, options;
  for (const CLI::Option* option : command->get_options())
    if (option->get_required() && option->count() == 0)
      (option->get_positional() ? names : options).push_back(option->get_name());
  names.insert(names.end(), options.begin(), options.end());
  if (names.empty()) return {};
  return boost::join(names, " and ") + (names.size() > 1 ? " are missing" : " is missing");
}

/// CLI11 would take the next argument as the value of `--option=`.
void refuseEmptyValues(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments)
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1)
      usageError(argument.substr(0, argument.size() - 1), "the value is empty");
}

/// CLI11 says `--option: At Most 1 required but received 2` and `--option: 1 required N missing`.
std::string problemOf(const CLI::ParseError& error) {
  const std::string text = error.what();
  if (!dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return text;
  return text.substr(0, text.find(':')) + (text.ends_with("missing") ? " needs a value" : " is given more than once");
}

/// Whether usageError() threw the error.
bool isWrongValue(const CLI::ParseError& error) { return dynamic_cast<const CLI::ValidationError*>(&error) != nullptr; }

/// share/hemitex beside the folder of the program; it may not exist.
std::filesystem::path folderBesideProgram() {
  std::error_code isUnknown;  // without /proc
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", isUnknown);
  return program.parent_path().parent_path() / "share" / "hemitex";
}

/// The help text, whose examples name the scenes of the sources, with the installed scenes where a person has no
/// others.
std::string withInstalledScenes(const std::string& help) {
  const std::filesystem::path folder = folderBesideProgram();
  if (std::filesystem::exists("data/cornell-box.obj") || !std::filesystem::exists(folder)) return help;
  return boost::replace_all_copy(help, " data/", ' ' + folder.string() + '/');
}

void addGlobalOptions(CLI::App& app, const Program& program, Context& context) {
  const auto setVerbosity = [&context](Verbosity verbosity) {
    return [&context, verbosity] { context.console.verbosity = verbosity; };
  };
  CLI::Option* quiet = app.add_flag_callback("-q,--quiet", setVerbosity(Verbosity::Quiet), "print errors only");
  app.add_flag_callback("-v,--verbose", setVerbosity(Verbosity::Verbose), "print details of the run")->excludes(quiet);
  app.add_flag("--json", context.json, "print one JSON object instead of text");
  addInteger(Command(app, context.paths), "--threads", context.threads, 0, maxThreads,
             "maximum number of threads; 0 means all cores (default 0)");
  app.add_flag("--insist", context.insists,
               "run with more than 2^24 elements, or with more memory than is free (default: refuse, with the number)");
  app.set_version_flag("--version", program.name + " " HEMITEX_VERSION);
}

/// Libraries that cannot start a thread say so in ways of their own.
bool isLackOfMemory(const std::exception& error) {
  const auto* const ofSystem = dynamic_cast<const std::system_error*>(&error);
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         (ofSystem != nullptr && ofSystem->code() == std::errc::resource_unavailable_try_again) ||
         std::string_view(error.what()).starts_with("pthread_create");
}

/// Ends the program where an exception cannot be caught, such as std::bad_alloc in a thread of a library.
[[noreturn]] void endUncaught() {
  removeTemporaryFolders();
  try {
    std::rethrow_exception(std::current_exception());
  } catch (const std::exception& error) {
    std::cerr << "hemitex: error: " << (isLackOfMemory(error) ? "out of memory" : error.what()) << std::endl;
  } catch (...) {
    std::cerr << "hemitex: error: internal error" << std::endl;
  }
  std::_Exit(ourFault);
}

/// The place of a process in a parallel run. mpirun and srun start a process per rank and tell each its rank by
/// environment variables. So a process knows its rank before it loads MPI.
struct LaunchedRank {
  int rank = 0;
  std::optional<int> ranks;  ///< nothing if the launcher does not tell
};

std::optional<int> numberIn(const char* variable) {
  const char* const text = variable != nullptr ? std::getenv(variable) : nullptr;
  return text != nullptr ? parseInteger(text) : std::nullopt;
}

/// The variables of a launcher. The number of ranks may be unknown.
struct Launcher {
  const char *rank, *ranks;
};

/// Open MPI's mpirun, PMI and PMIx (srun --mpi=pmi2 and pmix; that of MPICH is refused later). Slurm's own variables
/// are no evidence: they are also set for the script of a job, which runs once.
constexpr std::array launchers{Launcher{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                               Launcher{"PMI_RANK", "PMI_SIZE"}, Launcher{"PMIX_RANK", nullptr}};

/// The rank of this process if it was started with other ranks.
std::optional<LaunchedRank> launchedRank() {
  for (const Launcher& launcher : launchers)
    if (const std::optional<int> rank = numberIn(launcher.rank)) {
      const LaunchedRank launched{*rank, numberIn(launcher.ranks)};
      return launched.ranks == 1 ? std::nullopt : std::optional(launched);
    }
  return std::nullopt;
}

/// Throws InputError if MPI has other ranks than the launcher. This is so where the launcher belongs to another MPI.
void requireSameRanks(const radiosity::Messenger& ranks, const LaunchedRank& launched) {
  if (ranks.rank() != launched.rank || ranks.ranks() != launched.ranks.value_or(ranks.ranks()))
    throw raster::InputError("the launcher's MPI is not the one that hemitex was built with",
                             "start hemitex by mpirun of Open MPI, or by srun --mpi=pmix");
}

/// From now on, nothing that this process prints is seen.
void silence() {
  for (std::FILE* stream : {stdout, stderr})
    if (std::freopen("/dev/null", "w", stream) == nullptr) std::fclose(stream);
}

/// Reports an error of this rank to rank 0, and waits until rank 0 ends all ranks.
[[noreturn]] void reportToWriter(radiosity::Messenger& ranks, int exitCode, const std::string& text) {
  ranks.send(0, radiosity::MessageKind::Failed, static_cast<char>(exitCode) + text);
  while (true) {
    ranks.receive();  // lets MPI send
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

int run(const Program& program, int argc, char** argv, Context& context) {
  const std::optional<LaunchedRank> launched = launchedRank();
  const bool isHelper = launched && launched->rank > 0;
  if (isHelper) silence();
  CLI::App app(program.purpose, program.name);
  app.fallthrough();
  app.formatter(helpFormatter({}));
  app.set_help_all_flag("--help-all", "Print this help message with all options and exit");
  app.footer(
      "The options -q, -v, --json, --threads N, --insist, --help, --help-all and --version work before and after every "
      "command.");
  addGlobalOptions(app, program, context);
  const Command all(app, context.paths);
  std::filesystem::path shellFiles;
  all.addOutputFolder("--shell-files", shellFiles, "write completion scripts and manual pages into this folder")
      .hidden();
  program.addCommands(all, context);
  if (argc == 2 && argv[1] == std::string("--written-options")) {  // for tests of all that writes
    std::cout << writtenText(context.paths);
    return 0;
  }
  if (argc > 1 && argv[1] == std::string("--complete")) {  // an incomplete command line
    std::cout << completionsFor(commandTree(app), {argv + 2, argv + argc});
    return 0;
  }
  try {
    refuseEmptyValues({argv + 1, argv + argc});
    app.parse(argc, argv);
  } catch (const CLI::Success& helpOrVersion) {
    std::ostringstream text;
    const int code = app.exit(helpOrVersion, text);
    std::cout << withInstalledScenes(text.str());
    requireOutput();
    return code;
  } catch (const CLI::ParseError& error) {
    // An unknown argument often is the reason of other errors, such as a missing option.
    const std::vector<std::string> unknown = app.remaining(true);
    std::string problem = problemOf(error);
    if (!unknown.empty())
      problem = unknownArgument(commandTree(app), {argv + 1, argv + argc}, unknown.front());
    else if (const std::string missing = missingArguments(app); !missing.empty() && !isWrongValue(error))
      problem = missing;
    context.console.error(problem, adviceOf(program));
    return badInput;
  }
  if (isHelper && !context.isShared) return 0;
  if (!shellFiles.empty()) {
    Staging staging({.place = shellFiles, .writer = "shell-files"});
    writeShellFiles(staging.folder(), commandTree(app), HEMITEX_VERSION);
    staging.commit();
    return 0;
  }
  if (!context.command) {
    context.console.error("no command is given", adviceOf(program));
    return badInput;
  }
  const raster::ThreadLimit limit(context.threads);
  const raster::SizePolicy policy(context.insists, "add --insist to run all the same");
  if (launched && context.isShared) {
    context.ranks = program.joinRanks();
    requireSameRanks(*context.ranks, *launched);
  }
  // Launchers send a signal to all ranks, and rank 0 alone decides what the first one does.
  std::optional<LongRun> helping;
  if (!context.isWriter()) helping.emplace();
  context.command();
  requireOutput();
  if (!context.isWriter()) return 0;
  return stoppedExitCode().value_or(context.failed ? comparisonFailed : 0);
}

/// Reports an error on rank 0 and ends all ranks.
int failed(Context& context, int exitCode, const std::string& text) {
  if (!context.isWriter()) reportToWriter(*context.ranks, exitCode, text);
  context.console.error(text);
  if (context.ranks) context.ranks->abort(exitCode);
  return exitCode;
}

}  // namespace

std::string programVersion() { return HEMITEX_VERSION; }

void requireOutput(const std::string& state) {
  if (std::cout.flush()) return;
  if (isClosedPipe(STDOUT_FILENO)) throw ClosedPipe();
  throw raster::InputError("standard output cannot be written" + state, "check the disk or the pipe that it goes to");
}

std::filesystem::path sceneFolder() {
  const std::filesystem::path folder = folderBesideProgram();
  if (!std::filesystem::is_directory(folder))
    throw raster::InputError(folder.string(), 0, "does not exist, but should hold the scenes of the program",
                             "run the program from the folder into which `cmake --install` puts it");
  return folder;
}

int runProgram(const Program& program, int argc, char** argv) {
  std::signal(SIGABRT, [](int) { std::_Exit(ourFault); });  // raised by a failed assertion
  // Writing then fails with an error, which is reported, and temporary folders are removed.
  for (const int failure : {SIGPIPE, SIGXFSZ}) std::signal(failure, SIG_IGN);
  std::set_terminate(endUncaught);
  const PrintableStream output(std::cout);
  Context context;
  try {
    watchSignals();
    return run(program, argc, argv, context);
  } catch (const ClosedPipe&) {
    if (context.ranks) context.ranks->abort(closedPipe);
    return closedPipe;
  } catch (const raster::InputError& error) {
    return failed(context, badInput, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return failed(context, badInput, error.what());
  } catch (const radiosity::RankError& error) {
    return failed(context, error.exitCode, error.what());
  } catch (const std::exception& error) {
    if (isLackOfMemory(error)) return failed(context, ourFault, "out of memory; " + program.memoryAdvice);
    return failed(context, ourFault,
                  "internal error of " + program.name + "; please report it with the command line: " + error.what());
  }
}

}  // namespace hemitex::cli
