/// Commands and their options. Only three sources include CLI11, because its headers take seconds to compile:
/// command_line.cpp, program.cpp and command_tree.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hemitex::cli {

/// Reports a wrong value or combination of options; the program exits with code 2. Throws CLI::ValidationError.
[[noreturn]] void usageError(const std::string& option, const std::string& problem);

/// A handle to an option of a command.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required() const;
  /// Removes the option from help texts, completion and manual pages: it is for the build, not for users.
  Option hidden() const;
  /// At most one of the two options may be given.
  Option excludes(Option other) const;
  /// This option may be given only together with the other.
  Option needs(Option other) const;

 private:
  CLI::Option* option_;
};

/// A handle to the program or to one of its commands.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command addCommand(const std::string& name, const std::string& help) const;

  /// The same command; options that are added through the result belong to this topic of the help text.
  Command under(const std::string& topic) const { return Command(*app_, topic); }

  /// Adds an option with a value; `type` names the value in the help text. `read` gets the value and calls usageError
  /// if it is wrong. A name without a dash declares a positional argument.
  Option addText(const std::string& name, const std::string& type, const std::string& help,
                 const std::function<void(const std::string&)>& read) const;
  /// Adds a repeatable option; `read` gets all values.
  Option addTexts(const std::string& name, const std::string& type, const std::string& help,
                  const std::function<void(const std::vector<std::string>&)>& read) const;
  Option addText(const std::string& name, const std::string& type, const std::string& help, std::string& target) const;
  Option addPath(const std::string& name, std::filesystem::path& target, const std::string& help,
                 const std::string& type = "PATH") const;
  /// Adds an option without a value; if it is given, `action` is called.
  Option addFlag(const std::string& name, const std::string& help, const std::function<void()>& action) const;
  Option addFlag(const std::string& name, bool& target, const std::string& help) const;

  /// Restricts the text of `--help` to these options; `--help-all` shows all. For commands with more than ten options.
  /// Throws CLI::OptionNotFound for a name that is no option of the command.
  void showFirst(const std::vector<std::string>& options) const;

  /// Adds examples to the end of the help text: what follows the name of the command.
  void addExamples(const std::vector<std::string>& arguments) const;

  /// An option that this command already has.
  Option option(const std::string& name) const;
  /// Whether an option was given; valid after the command line is read.
  bool isGiven(const std::string& name) const;
  /// Sets the function that is called after the command line is read, if it contains this command.
  void onRead(const std::function<void()>& action) const;

 private:
  Command(CLI::App& app, std::string topic) : app_(&app), topic_(std::move(topic)) {}
  Option inTopic(CLI::Option& option) const;

  CLI::App* app_;
  std::string topic_;  ///< empty: no topic
};

}  // namespace hemitex::cli
