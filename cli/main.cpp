/// hemitex, the program: radiosity on the command line. Results go to stdout, everything else to stderr; the exit code
/// is 0 where all went well, 1 where a comparison failed, 2 where the input or the usage is wrong, 3 where the fault is
/// ours.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <new>

#include "cli/common/commands.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace {

using namespace hemitex;

constexpr int comparisonFailed = 1;
constexpr int badInput = 2;
constexpr int ourFault = 3;
constexpr int maxThreads = 4096;
const std::string advice = "Run hemitex --help, or hemitex COMMAND --help.";

void addGlobalOptions(CLI::App& program, cli::Context& context) {
  using cli::Verbosity;
  const auto setVerbosity = [&context](Verbosity verbosity) {
    return [&context, verbosity] { context.console.verbosity = verbosity; };
  };
  CLI::Option* quiet = program.add_flag_callback("-q,--quiet", setVerbosity(Verbosity::Quiet), "say errors only");
  program.add_flag_callback("-v,--verbose", setVerbosity(Verbosity::Verbose), "say more")->excludes(quiet);
  program.add_flag("--json", context.json, "print one JSON object instead of text");
  cli::addInteger(cli::Command(program), "--threads", context.threads, 0, maxThreads,
                  "threads at most (default 0: all cores)");
  program.set_version_flag("--version", "hemitex " HEMITEX_VERSION);
}

/// Reads the line and does what it says.
int run(int argc, char** argv, cli::Context& context) {
  CLI::App program("Texture-based hemicube radiosity: an OBJ scene goes in, a lit scene comes out.", "hemitex");
  program.fallthrough();
  program.footer("Every command takes -q, -v, --json, --threads N, --help and --version, before or after its name.");
  addGlobalOptions(program, context);
  const cli::Command commands(program);
  cli::addSolve(commands, context);
  cli::addRender(commands, context);
  cli::addFormFactors(commands, context);
  cli::addTradeoff(commands, context);
  cli::addPaper(commands, context);
  cli::addBench(commands, context);
  cli::addVector(commands, context);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& helpOrVersion) {
    return program.exit(helpOrVersion);
  } catch (const CLI::ParseError& error) {
    context.console.error(error.what() + ('\n' + advice));
    return badInput;
  }
  if (!context.command) {
    context.console.error("a command is needed\n" + advice);
    return badInput;
  }
  const raster::ThreadLimit limit(context.threads);
  context.command();
  if (!std::cout.flush()) throw raster::InputError("standard output cannot be written");
  return context.failed ? comparisonFailed : 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGABRT, [](int) { std::_Exit(ourFault); });  // an assertion that failed
  cli::Context context;
  try {
    return run(argc, argv, context);
  } catch (const raster::InputError& error) {
    context.console.error(error.what());
    return badInput;
  } catch (const std::filesystem::filesystem_error& error) {
    context.console.error(error.what());
    return badInput;
  } catch (const std::bad_alloc&) {
    context.console.error("out of memory; try fewer texels (--texels) or a smaller --row-cache");
  } catch (const std::exception& error) {
    context.console.error(std::string("this is a fault of hemitex, not of the input: ") + error.what());
  }
  return ourFault;
}
