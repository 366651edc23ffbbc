#include "cli/help/completion.h"

#include <algorithm>
#include <set>

#include "radiosity/base/name_suggestions.h"

namespace hemitex::cli {
namespace {

/// The innermost command that the words name.
const CommandInfo& commandAt(const CommandInfo& program, const std::vector<std::string>& words) {
  const CommandInfo* command = &program;
  for (const std::string& word : words)
    for (const CommandInfo& inner : command->commands)
      if (inner.word() == word) {
        command = &inner;
        break;
      }
  return *command;
}

/// The options that work with a command: its own and those of the program.
std::vector<OptionInfo> optionsOf(const CommandInfo& program, const CommandInfo& command) {
  std::vector<OptionInfo> options = command.options;
  options.insert(options.end(), program.options.begin(), program.options.end());
  return options;
}

bool hasName(const OptionInfo& option, const std::string& name) {
  return std::find(option.names.begin(), option.names.end(), name) != option.names.end();
}

/// The names of the options with their help; the program has some of the options of its commands, too.
std::string namesOf(const std::vector<OptionInfo>& options) {
  std::string completions;
  std::set<std::string> known;
  for (const OptionInfo& option : options)
    for (const std::string& name : option.names)
      if (known.insert(name).second) completions += name + '\t' + option.help + '\n';
  return completions;
}

}  // namespace

std::string completionsFor(const CommandInfo& program, const std::vector<std::string>& words) {
  const std::string current = words.empty() ? "" : words.back(), before = words.size() < 2 ? "" : words.end()[-2];
  const CommandInfo& command = commandAt(program, {words.begin(), words.end() - (words.empty() ? 0 : 1)});
  const std::vector<OptionInfo> options = optionsOf(program, command);
  std::string completions;
  for (const OptionInfo& option : options)
    if (!option.value.empty() && hasName(option, before)) {
      for (const std::string& choice : option.choices) completions += choice + '\n';
      return option.isPath() ? fileCompletion + '\n' : completions;
    }
  if (current.starts_with('-')) return namesOf(options);
  for (const OptionInfo& argument : command.arguments)
    if (argument.isPath()) return (hasName(argument, "SCENE") ? sceneCompletion : fileCompletion) + '\n';
  for (const CommandInfo& inner : command.commands) completions += inner.word() + '\t' + inner.help + '\n';
  return completions;
}

std::string unknownArgument(const CommandInfo& program, const std::vector<std::string>& arguments,
                            const std::string& unknown) {
  // A later word may be the name of a command by chance, such as that of a folder.
  const CommandInfo& command =
      commandAt(program, {arguments.begin(), std::find(arguments.begin(), arguments.end(), unknown)});
  const std::string argument = unknown.substr(0, unknown.find('='));
  const bool isOption = argument.starts_with('-');
  std::set<std::string> names;
  if (isOption)
    for (const OptionInfo& option : optionsOf(program, command)) names.insert(option.names.begin(), option.names.end());
  else
    for (const CommandInfo& inner : command.commands) names.insert(inner.word());
  if (names.empty()) return "`" + command.name + "` takes no further argument `" + unknown + "`";
  return "`" + argument + "` is no " + (isOption ? "option" : "command") + " of `" + command.name +
         "`; similar names: " + radiosity::nearestNames(names, argument);
}

}  // namespace hemitex::cli
