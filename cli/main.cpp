/// The program hemitex: reads the command line and runs a command. Results go to stdout, messages to stderr. Exit
/// codes: 0 done; 1 a comparison failed; 2 the input or the usage is wrong; 3 internal error.
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
const std::string advice = "Run `hemitex --help` or `hemitex COMMAND --help` for the options.";

void addGlobalOptions(CLI::App& program, cli::Context& context) {
  using cli::Verbosity;
  const auto setVerbosity = [&context](Verbosity verbosity) {
    return [&context, verbosity] { context.console.verbosity = verbosity; };
  };
  CLI::Option* quiet = program.add_flag_callback("-q,--quiet", setVerbosity(Verbosity::Quiet), "print errors only");
  program.add_flag_callback("-v,--verbose", setVerbosity(Verbosity::Verbose), "print details of the run")
      ->excludes(quiet);
  program.add_flag("--json", context.json, "print one JSON object instead of text");
  cli::addInteger(cli::Command(program), "--threads", context.threads, 0, maxThreads,
                  "maximum number of threads; 0 means all cores (default 0)");
  program.set_version_flag("--version", "hemitex " HEMITEX_VERSION);
}

/// Reads the command line, runs its command and returns the exit code.
int run(int argc, char** argv, cli::Context& context) {
  CLI::App program(
      "hemitex computes the light of an OBJ scene by radiosity and writes the scene with its light in textures.",
      "hemitex");
  program.fallthrough();
  program.footer("The options -q, -v, --json, --threads N, --help and --version work before and after every command.");
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
    context.console.error("no command is given\n" + advice);
    return badInput;
  }
  const raster::ThreadLimit limit(context.threads);
  context.command();
  if (!std::cout.flush())
    throw raster::InputError("standard output cannot be written; check the disk or the pipe that it goes to");
  return context.failed ? comparisonFailed : 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGABRT, [](int) { std::_Exit(ourFault); });  // raised by a failed assertion
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
    context.console.error("out of memory; use fewer texels (--texels) or a smaller --row-cache");
  } catch (const std::exception& error) {
    context.console.error(std::string("internal error of hemitex; please report it with the command line: ") +
                          error.what());
  }
  return ourFault;
}
