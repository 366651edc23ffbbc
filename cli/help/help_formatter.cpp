#include "cli/help/help_formatter.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <utility>

#include "cli/help/command_tree.h"

namespace hemitex::cli {
namespace {

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

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormatter(const std::vector<std::string>& first) {
  return std::make_shared<HelpFormatter>(first);
}

}  // namespace hemitex::cli
