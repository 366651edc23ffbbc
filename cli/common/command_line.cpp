#include "cli/common/command_line.h"

#include <CLI/CLI.hpp>

#include "cli/common/console.h"
#include "cli/help/command_tree.h"

namespace hemitex::cli {

void usageError(const std::string& option, const std::string& problem) {
  throw CLI::ValidationError(option, shortened(problem, 300));
}

Option Option::required() const { return Option(*option_->required()); }
Option Option::hidden() const { return Option(*option_->group("")); }
Option Option::excludes(Option other) const { return Option(*option_->excludes(other.option_)); }
Option Option::needs(Option other) const { return Option(*option_->needs(other.option_)); }

Command Command::addCommand(const std::string& name, const std::string& help) const {
  return Command(*app_->add_subcommand(name, help));
}

Option Command::addText(const std::string& name, const std::string& type, const std::string& help,
                        const std::function<void(const std::string&)>& read) const {
  return inTopic(*app_->add_option_function<std::string>(name, read, help)->type_name(type));
}

Option Command::addTexts(const std::string& name, const std::string& type, const std::string& help,
                         const std::function<void(const std::vector<std::string>&)>& read) const {
  CLI::Option* const option = app_->add_option_function<std::vector<std::string>>(name, read, help);
  // Each use of an option takes one value, so that a positional argument may follow.
  if (name.starts_with('-')) option->allow_extra_args(false);
  return inTopic(*option->type_name(type));
}

Option Command::addText(const std::string& name, const std::string& type, const std::string& help,
                        std::string& target) const {
  return addText(name, type, help, [&target](const std::string& text) { target = text; });
}

Option Command::addPath(const std::string& name, std::filesystem::path& target, const std::string& help,
                        const std::string& type) const {
  return addText(name, type, help, [&target](const std::string& text) { target = text; });
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
