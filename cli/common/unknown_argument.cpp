#include "cli/common/unknown_argument.h"

#include <CLI/CLI.hpp>
#include <set>

#include "cli/help/command_tree.h"
#include "raster/base/name_suggestions.h"

namespace hemitex::cli {
namespace {

/// The innermost command that the command line names.
const CLI::App& givenCommand(const CLI::App& app) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  return given.empty() ? app : givenCommand(*given.front());
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

std::string unknownArgument(const CLI::App& program) {
  const std::vector<std::string> unknown = program.remaining(true);
  if (unknown.empty()) return {};
  const std::string argument = unknown.front().substr(0, unknown.front().find('='));
  const CLI::App& command = givenCommand(program);
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
