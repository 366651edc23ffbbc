/// Commands and their options. Only three sources include CLI11, because its headers take seconds to compile:
/// command_line.cpp, program.cpp and command_tree.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hemitex::cli {

/// Reports a wrong value or combination of options; the program exits with code 2. Throws CLI::ValidationError.
[[noreturn]] void usageError(const std::string& option, const std::string& problem);

/// The options of all commands that are paths: those that are read, and those that are written. Every path is one of
/// them, so that no result can replace an input of its run, and tests find each option that writes.
struct PathOptions {
  struct Written {
    std::string command;
    CLI::Option* option;
    bool isFolder;
  };
  std::vector<CLI::Option*> read;
  std::vector<Written> written;
};

/// The values of the options that are read, of those that were given.
std::set<std::filesystem::path> givenInputs(const PathOptions& paths);
/// A line for each option that is written: the command, the names of the option, and `file` or `folder`.
std::string writtenText(const PathOptions& paths);

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
  Command(CLI::App& app, PathOptions& paths) : app_(&app), paths_(&paths) {}

  Command addCommand(const std::string& name, const std::string& help) const;

  /// The same command; options that are added through the result belong to this topic of the help text.
  Command under(const std::string& topic) const;

  /// Adds an option with a value; `type` names the value in the help text. `read` gets the value and calls usageError
  /// if it is wrong. A name without a dash declares a positional argument.
  Option addText(const std::string& name, const std::string& type, const std::string& help,
                 const std::function<void(const std::string&)>& read) const;
  /// Adds a repeatable option; `read` gets each value.
  Option addTexts(const std::string& name, const std::string& type, const std::string& help,
                  const std::function<void(const std::string&)>& read) const;
  Option addText(const std::string& name, const std::string& type, const std::string& help, std::string& target) const;
  /// Adds an option for a file or folder that the command reads.
  Option addPath(const std::string& name, std::filesystem::path& target, const std::string& help,
                 const std::string& type = "PATH") const;
  /// As above; `read` gets the path.
  Option addPath(const std::string& name, const std::string& type, const std::string& help,
                 const std::function<void(const std::string&)>& read) const;
  /// As addTexts, of files that the command reads.
  Option addPaths(const std::string& name, std::vector<std::filesystem::path>& targets, const std::string& help) const;
  /// Adds an option for a file or a folder that the command writes.
  Option addOutputFile(const std::string& name, std::filesystem::path& target, const std::string& help,
                       const std::string& type = "PATH") const;
  Option addOutputFolder(const std::string& name, std::filesystem::path& target, const std::string& help) const;
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
  Option inTopic(CLI::Option& option) const;
  CLI::Option& pathOption(const std::string& name, const std::string& type, const std::string& help,
                          const std::function<void(const std::string&)>& read) const;

  CLI::App* app_;
  PathOptions* paths_;
  std::string topic_;  ///< empty: no topic
};

}  // namespace hemitex::cli
