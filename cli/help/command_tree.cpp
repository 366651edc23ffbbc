#include "cli/help/command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <set>
#include <utility>

#include "radiosity/base/name_suggestions.h"

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

/// The options of a command under one heading.
struct Topic {
  std::string name;
  std::vector<const CLI::Option*> options;
};

/// The options of a command, without hidden and positional ones, by topic in the order in which they were added.
/// Options without a topic come last.
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

class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::vector<std::string> first) : first_(std::move(first)) {}

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return make_description(app) + make_usage(app, name) + make_positionals(app) + optionsText(*app, mode) +
           make_subcommands(app, CLI::AppFormatMode::Normal) + '\n' + make_footer(app);
  }

  /// As CLI::Formatter, but other options are in the order of their names: CLI11 orders them by their addresses.
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text;
    if (option->get_type_size() != 0) {
      if (!option->get_type_name().empty()) text += ' ' + option->get_type_name();
      if (option->get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
      if (option->get_required()) text += " REQUIRED";
    }
    return text + list("Needs", option->get_needs()) + list("Excludes", option->get_excludes());
  }

 private:
  std::string optionsText(const CLI::App& app, CLI::AppFormatMode mode) const {
    std::string text;
    std::size_t omitted = 0;
    for (const Topic& topic : topicsOf(app)) {
      std::vector<const CLI::Option*> shown;
      for (const CLI::Option* option : topic.options)
        if (mode == CLI::AppFormatMode::All || isFirst(app, *option)) shown.push_back(option);
      omitted += topic.options.size() - shown.size();
      if (!shown.empty()) text += make_group(topic.name, false, shown);
    }
    if (omitted > 0) text += "\n" + std::to_string(omitted) + " more options: " + fullNameOf(app) + " --help-all\n";
    return text;
  }

  bool isFirst(const CLI::App& app, const CLI::Option& option) const {
    const bool isHelp = &option == app.get_help_ptr() || &option == app.get_help_all_ptr();
    return first_.empty() || isHelp ||
           std::any_of(first_.begin(), first_.end(), [&](const std::string& name) { return option.check_name(name); });
  }

  static std::string list(const std::string& title, const std::set<CLI::Option*>& options) {
    std::set<std::string> names;
    for (const CLI::Option* option : options) names.insert(option->get_name());
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? ' ' + title + ": " : " ") + name;
    return text;
  }

  std::vector<std::string> first_;
};

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

bool OptionInfo::isPath() const { return value == "PATH" || value.starts_with("FILE."); }

std::string fullNameOf(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : fullNameOf(*app.get_parent()) + ' ' + app.get_name();
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

std::shared_ptr<CLI::FormatterBase> helpFormatter(const std::vector<std::string>& first) {
  return std::make_shared<HelpFormatter>(first);
}

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
