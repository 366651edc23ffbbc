/// The commands of a program and their options as plain data, of which manual pages are made, the text that `--help`
/// and
/// `--help-all` print, and names on a command line: what may follow, which the completion scripts of shells
/// (shell_files.h) ask the program for, and what may be meant by a wrong one.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class FormatterBase;
}  // namespace CLI

namespace hemitex::cli {

struct OptionInfo {
  std::vector<std::string> names;  ///< such as `-o` and `--output`; a positional argument has one name without a dash
  std::string value;               ///< what the value is, such as `N` or `PATH`; empty for a flag
  std::string help;
  std::string topic;                 ///< heading of the help text
  std::vector<std::string> choices;  ///< all values, if they have names
  bool isRequired = false;

  bool isPath() const;
};

struct CommandInfo {
  std::string name;                   ///< with the program and the outer commands, such as `hemitex vector check`
  std::string help;                   ///< one sentence
  std::vector<OptionInfo> options;    ///< ordered by topic
  std::vector<OptionInfo> arguments;  ///< positional arguments
  std::vector<CommandInfo> commands;
  std::vector<std::string> examples;  ///< complete command lines

  /// The last word of the name.
  std::string word() const { return name.substr(name.rfind(' ') + 1); }
};

/// The name of a command with the names of the program and of the outer commands before it.
std::string fullNameOf(const CLI::App& app);

/// Describes a command or program and its subcommands, without hidden options. Examples are the indented lines of the
/// footer.
CommandInfo commandTree(const CLI::App& app);

/// Formats the help of a command, its options by topic. `--help` shows only the options in `first`, or all if it is
/// empty; `--help-all` shows all.
std::shared_ptr<CLI::FormatterBase> helpFormatter(const std::vector<std::string>& first);

/// The only completion where the path of a file is expected, and where that of a scene is.
inline const std::string fileCompletion = "<files>", sceneCompletion = "<scenes>";

/// Offers for the last of `words`, which follow the name of the program; it may be incomplete or empty. One line each,
/// a text or a text, a tab and its help: the values of the option before it, the options of the command if it begins
/// with a dash, or the commands.
std::string completionsFor(const CommandInfo& program, const std::vector<std::string>& words);

/// Says that the program does not know `unknown`, the first such argument of `arguments`, and which options or commands
/// have similar names.
std::string unknownArgument(const CommandInfo& program, const std::vector<std::string>& arguments,
                            const std::string& unknown);

}  // namespace hemitex::cli
