/// Commands and their options. Only command_line.cpp and main.cpp include CLI11, because its headers take seconds to
/// compile.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hemitex::cli {

/// The user's fault in the value of an option, or in what goes with it: exit code 2. Throws CLI::ValidationError.
[[noreturn]] void usageError(const std::string& option, const std::string& problem);

/// A handle to an option of a command.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required() const;
  /// Only one of the two may be given.
  Option excludes(Option other) const;
  /// May be given only with the other.
  Option needs(Option other) const;

 private:
  CLI::Option* option_;
};

/// A handle to the program or to one of its commands.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command addCommand(const std::string& name, const std::string& help) const;

  /// An option with a value; `type` names the value in the help text. `read` gets the value, or throws by usageError.
  /// A name without a dash is that of a positional argument.
  Option addText(const std::string& name, const std::string& type, const std::string& help,
                 const std::function<void(const std::string&)>& read) const;
  /// The same, repeatable: `read` gets all values.
  Option addTexts(const std::string& name, const std::string& type, const std::string& help,
                  const std::function<void(const std::vector<std::string>&)>& read) const;
  Option addPath(const std::string& name, std::filesystem::path& target, const std::string& help) const;
  /// An option without a value. `action` is called when it is given.
  Option addFlag(const std::string& name, const std::string& help, const std::function<void()>& action) const;
  Option addFlag(const std::string& name, bool& target, const std::string& help) const;

  /// An option that was added before.
  Option option(const std::string& name) const;
  /// Whether an option was given, once the command line is read.
  bool isGiven(const std::string& name) const;
  /// Calls `action` when the command line is read and holds the command.
  void onRead(const std::function<void()>& action) const;

 private:
  CLI::App* app_;
};

}  // namespace hemitex::cli
