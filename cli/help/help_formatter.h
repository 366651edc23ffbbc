/// The text that `--help` and `--help-all` print: the options of a command by topic.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class FormatterBase;
}  // namespace CLI

namespace hemitex::cli {

/// Formats the help of a command. `--help` shows only the options in `first`, or all if it is empty; `--help-all` shows
/// all.
std::shared_ptr<CLI::FormatterBase> helpFormatter(const std::vector<std::string>& first);

}  // namespace hemitex::cli
