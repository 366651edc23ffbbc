#include "cli/common/unknown_argument.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "cli/help/command_tree.h"
#include "raster/base/name_suggestions.h"

namespace hemitex::cli {
namespace {

using Words = std::vector<std::string>;

/// The innermost command whose name is among the words before `end`.
const CLI::App& commandBefore(const CLI::App& app, const Words& words, Words::const_iterator end) {
  for (const CLI::App* command : app.get_subcommands())
    if (std::find(words.begin(), end, command->get_name()) != end) return commandBefore(*command, words, end);
  return app;
}

std::set<std::string> optionsOf(const CLI::App& program, const CLI::App& command) {
  std::set<std::string> names;
  for (const CLI::App* app : {&program, &command})
    for (const OptionInfo& option : commandTree(*app).options) names.insert(option.names.begin(), option.names.end());
  return names;
}

std::set<std::string> commandsOf(const CLI::App& app) {
  std::set<std::string> names;
  for (const CommandInfo& command : commandTree(app).commands) names.insert(command.word());
  return names;
}

}  // namespace

std::string unknownArgument(const CLI::App& program, const std::vector<std::string>& arguments) {
  const std::vector<std::string> unknown = program.remaining(true);
  if (unknown.empty()) return {};
  const std::string argument = unknown.front().substr(0, unknown.front().find('='));
  // A later word may be the name of a command by chance, such as that of a folder.
  const CLI::App& command =
      commandBefore(program, arguments, std::find(arguments.begin(), arguments.end(), unknown.front()));
  const std::string name = fullNameOf(command);
  const auto message = [&](const std::string& kind, const std::set<std::string>& names) {
    return "`" + argument + "` is " + kind + " of `" + name +
           "`; similar names: " + raster::nearestNames(names, argument);
  };
  if (argument.starts_with('-')) return message("no option", optionsOf(program, command));
  const std::set<std::string> commands = commandsOf(command);
  return commands.empty() ? "`" + name + "` takes no further argument `" + unknown.front() + "`"
                          : message("no command", commands);
}

}  // namespace hemitex::cli
