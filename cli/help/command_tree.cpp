#include "cli/help/command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <boost/algorithm/string.hpp>

namespace hemitex::cli {
namespace {

std::vector<std::string> split(const std::string& text, const char* separator) {
  std::vector<std::string> parts;
  return boost::split(parts, text, boost::is_any_of(separator));
}

OptionInfo describe(const CLI::Option& option) {
  OptionInfo info;
  for (const std::string& letter : option.get_snames()) info.names.push_back("-" + letter);
  for (const std::string& name : option.get_lnames()) info.names.push_back("--" + name);
  if (option.get_positional()) info.names.push_back(option.get_name(true));
  if (option.get_type_size() != 0) info.value = option.get_type_name();
  info.help = option.get_description();
  if (info.value.find('|') != std::string::npos) info.choices = split(info.value, "|");
  info.isRequired = option.get_required();
  return info;
}

bool isHidden(const CLI::Option& option) { return option.get_group().empty(); }

}  // namespace

bool OptionInfo::isPath() const { return value == "PATH" || value.starts_with("FILE."); }

std::string fullNameOf(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : fullNameOf(*app.get_parent()) + ' ' + app.get_name();
}

std::vector<Topic> topicsOf(const CLI::App& app) {
  const std::string none = CLI::OptionDefaults().get_group();
  std::vector<Topic> topics;
  Topic rest{none, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (isHidden(*option) || option->get_positional()) continue;
    const std::string& name = option->get_group();
    const auto known =
        std::find_if(topics.begin(), topics.end(), [&](const Topic& topic) { return topic.name == name; });
    if (name == none)
      rest.options.push_back(option);
    else if (known != topics.end())
      known->options.push_back(option);
    else
      topics.push_back({name, {option}});
  }
  if (!topics.empty()) rest.name = "Other";
  if (!rest.options.empty()) topics.push_back(rest);
  return topics;
}

CommandInfo commandTree(const CLI::App& app) {
  CommandInfo info;
  info.name = fullNameOf(app);
  info.help = app.get_description();
  for (const CLI::Option* option : app.get_options())
    if (!isHidden(*option) && option->get_positional()) info.arguments.push_back(describe(*option));
  for (const Topic& topic : topicsOf(app))
    for (const CLI::Option* option : topic.options) {
      info.options.push_back(describe(*option));
      info.options.back().topic = topic.name;
    }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    info.commands.push_back(commandTree(*command));
  for (const std::string& line : split(app.get_footer(), "\n"))
    if (line.starts_with("  ")) info.examples.push_back(line.substr(2));
  return info;
}

std::vector<CommandInfo> allCommands(const CommandInfo& command) {
  std::vector<CommandInfo> all = {command};
  for (const CommandInfo& inner : command.commands) {
    const std::vector<CommandInfo> below = allCommands(inner);
    all.insert(all.end(), below.begin(), below.end());
  }
  return all;
}

}  // namespace hemitex::cli
