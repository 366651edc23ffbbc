#include "cli/common/command_line.h"

#include <CLI/CLI.hpp>

#include "cli/common/console.h"
#include "cli/help/command_tree.h"

namespace hemitex::cli {
namespace {

/// Throws a usage error for an empty value, which is no number, name or path. As a path it would count as not given.
void refuseEmpty(const std::string& option, const std::string& value) {
  if (value.empty()) usageError(option, "the value is empty");
}

}  // namespace

void usageError(const std::string& option, const std::string& problem) {
  throw CLI::ValidationError(option, shortened(problem, 300));
}

std::set<std::filesystem::path> givenInputs(const PathOptions& paths) {
  std::set<std::filesystem::path> inputs;
  for (const CLI::Option* option : paths.read) inputs.insert(option->results().begin(), option->results().end());
  return inputs;
}

std::string writtenText(const PathOptions& paths) {
  std::string text;
  for (const auto& [command, option, isFolder] : paths.written)
    text += command + '\t' + option->get_name(false, true) + '\t' + (isFolder ? "folder" : "file") + '\n';
  return text;
}

Option Option::required() const { return Option(*option_->required()); }
Option Option::hidden() const { return Option(*option_->group("")); }
Option Option::excludes(Option other) const { return Option(*option_->excludes(other.option_)); }
Option Option::needs(Option other) const { return Option(*option_->needs(other.option_)); }

Command Command::addCommand(const std::string& name, const std::string& help) const {
  return Command(*app_->add_subcommand(name, help), *paths_);
}

Command Command::under(const std::string& topic) const {
  Command command = *this;
  command.topic_ = topic;
  return command;
}

Option Command::addText(const std::string& name, const std::string& type, const std::string& help,
                        const std::function<void(const std::string&)>& read) const {
  const auto readFull = [name, read](const std::string& text) {
    refuseEmpty(name, text);
    read(text);
  };
  return inTopic(*app_->add_option_function<std::string>(name, readFull, help)->type_name(type));
}

Option Command::addTexts(const std::string& name, const std::string& type, const std::string& help,
                         const std::function<void(const std::string&)>& read) const {
  const auto readFull = [name, read](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) refuseEmpty(name, text);
    for (const std::string& text : texts) read(text);
  };
  CLI::Option* const option = app_->add_option_function<std::vector<std::string>>(name, readFull, help);
  // Each use of an option takes one value, so that a positional argument may follow.
  if (name.starts_with('-')) option->allow_extra_args(false);
  return inTopic(*option->type_name(type));
}

Option Command::addText(const std::string& name, const std::string& type, const std::string& help,
                        std::string& target) const {
  return addText(name, type, help, [&target](const std::string& text) { target = text; });
}

CLI::Option& Command::pathOption(const std::string& name, const std::string& type, const std::string& help,
                                 const std::function<void(const std::string&)>& read) const {
  addText(name, type, help, read);
  return *app_->get_option(name.substr(name.rfind(',') + 1));
}

Option Command::addPath(const std::string& name, const std::string& type, const std::string& help,
                        const std::function<void(const std::string&)>& read) const {
  paths_->read.push_back(&pathOption(name, type, help, read));
  return Option(*paths_->read.back());
}

Option Command::addPath(const std::string& name, std::filesystem::path& target, const std::string& help,
                        const std::string& type) const {
  return addPath(name, type, help, [&target](const std::string& text) { target = text; });
}

Option Command::addPaths(const std::string& name, std::vector<std::filesystem::path>& targets,
                         const std::string& help) const {
  const Option option =
      addTexts(name, "PATH", help, [&targets](const std::string& text) { targets.emplace_back(text); });
  paths_->read.push_back(app_->get_option(name));
  return option;
}

Option Command::addOutputFile(const std::string& name, std::filesystem::path& target, const std::string& help,
                              const std::string& type) const {
  CLI::Option& option = pathOption(name, type, help, [&target](const std::string& text) { target = text; });
  paths_->written.push_back({fullNameOf(*app_), &option, false});
  return Option(option);
}

Option Command::addOutputFolder(const std::string& name, std::filesystem::path& target, const std::string& help) const {
  CLI::Option& option = pathOption(name, "PATH", help, [&target](const std::string& text) { target = text; });
  paths_->written.push_back({fullNameOf(*app_), &option, true});
  return Option(option);
}

Option Command::addFlag(const std::string& name, const std::string& help, const std::function<void()>& action) const {
  return inTopic(*app_->add_flag_callback(name, action, help));
}

Option Command::addFlag(const std::string& name, bool& target, const std::string& help) const {
  return addFlag(name, help, [&target] { target = true; });
}

void Command::showFirst(const std::vector<std::string>& options) const {
  for (const std::string& name : options) app_->get_option(name);
  app_->formatter(helpFormatter(options));
}

void Command::addExamples(const std::vector<std::string>& arguments) const {
  std::string text = "Examples:\n";
  for (const std::string& example : arguments) text += "  " + fullNameOf(*app_) + ' ' + example + '\n';
  // A function, because commands inherit the footer that is a text.
  app_->footer([text] { return text; });
}

Option Command::inTopic(CLI::Option& option) const {
  if (!topic_.empty()) option.group(topic_);
  return Option(option);
}

Option Command::option(const std::string& name) const { return Option(*app_->get_option(name)); }

bool Command::isGiven(const std::string& name) const { return app_->count(name) > 0; }

void Command::onRead(const std::function<void()>& action) const { app_->callback(action); }

}  // namespace hemitex::cli
