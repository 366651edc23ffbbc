/// Options with values: reads and checks them. A wrong value is a usage error that names the option.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/common/command_line.h"
#include "cli/common/console.h"
#include "cli/common/numbers.h"

namespace hemitex::radiosity {
class Messenger;
}

namespace hemitex::cli {

/// The state that all commands share. The given command stores its work in `command`. The program calls it after the
/// whole command line is read.
struct Context {
  Console console;
  bool json = false;
  int threads = 0;       ///< 0: all cores
  bool insists = false;  ///< run whatever the size (see raster/base/memory_budget.h)
  std::function<void()> command;
  PathOptions paths;
  /// Whether the ranks of a parallel run share the work of the command. Otherwise rank 0 does it alone.
  bool isShared = false;
  std::shared_ptr<radiosity::Messenger> ranks;  ///< while a shared command runs with several ranks; otherwise null

  /// Whether this process writes the results: alone or as rank 0.
  bool isWriter() const;
  /// The files that the command line names as inputs, and those that they led to.
  std::set<std::filesystem::path> inputs(const std::vector<std::filesystem::path>& others = {}) const;
  bool failed = false;  ///< set by a command if its comparison or verification failed
};

/// Reads the value of an option as an integer in [low, high]. Throws a usage error.
int integerOption(const std::string& name, const std::string& text, int low, int high);
/// As integerOption for a power of two.
int powerOfTwoOption(const std::string& name, const std::string& text, int low, int high);
/// Reads the value of an option as a number above 0 and below `limit`, which may be infinite. Throws a usage error.
double positiveOption(const std::string& name, const std::string& text, double limit);
/// Reads the value of an option as a vector `x,y,z`. Throws a usage error.
glm::dvec3 vectorOption(const std::string& name, const std::string& text);

/// Adds an option with an integer in [low, high]. `target` is an int or an optional int.
template <typename Target>
Option addInteger(Command command, const std::string& name, Target& target, int low, int high,
                  const std::string& help) {
  const auto read = [&target, name, low, high](const std::string& text) {
    target = integerOption(name, text, low, high);
  };
  return command.addText(name, "N", help, read);
}

/// Adds `--seed`, which gives rays another random sequence.
Option addSeed(Command command, std::uint32_t& seed);

/// Adds an option with a number above 0 and below `limit`. `target` is a double or an optional double.
template <typename Target>
Option addPositive(Command command, const std::string& name, Target& target, double limit, const std::string& help) {
  const auto read = [&target, name, limit](const std::string& text) { target = positiveOption(name, text, limit); };
  return command.addText(name, "X", help, read);
}

/// Adds an option with a vector `x,y,z`. `target` is a vector or an optional vector.
template <typename Target>
Option addVectorOption(Command command, const std::string& name, Target& target, const std::string& help) {
  const auto read = [&target, name](const std::string& text) { target = vectorOption(name, text); };
  return command.addText(name, "x,y,z", help, read);
}

/// The names of values, for options and for JSON.
template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// The name of a value that is among the choices.
template <typename Value>
std::string nameOf(const Choices<Value>& choices, const Value& value) {
  for (const auto& choice : choices)
    if (choice.second == value) return choice.first;
  return {};
}

/// Adds an option with a list of names, one per value. `target` is a value or an optional value.
template <typename Value, typename Target>
Option addChoice(Command command, const std::string& name, Target& target, const Choices<Value>& choices,
                 const std::string& help) {
  std::string words;
  for (const auto& choice : choices) words += (words.empty() ? "" : "|") + choice.first;
  const auto read = [&target, name, choices, words](const std::string& text) {
    for (const auto& choice : choices)
      if (choice.first == text) {
        target = choice.second;
        return;
      }
    usageError(name, "`" + text + "` is none of " + words);
  };
  return command.addText(name, words, help, read);
}

/// Adds the required option `-o`.
Option addOutput(Command command, std::filesystem::path& output, const std::string& help);

}  // namespace hemitex::cli
