#include "cli/common/console.h"

#include <unistd.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <iostream>

namespace hemitex::cli {
namespace {

constexpr int barLength = 30;
constexpr std::size_t maxLine = 1000;
constexpr std::chrono::milliseconds barInterval{100};
constexpr std::chrono::seconds lineInterval{10};

}  // namespace

std::string shortened(const std::string& text, std::size_t maxBytes) {
  if (text.size() <= maxBytes) return text;
  const std::size_t tail = maxBytes / 3;
  return text.substr(0, maxBytes - tail) + " ... " + text.substr(text.size() - tail);
}

std::string shellQuoted(const std::string& text) { return '\'' + boost::replace_all_copy(text, "'", "'\\''") + '\''; }

void Console::error(const std::string& text) { print("hemitex: error: " + text); }

void Console::warning(const std::string& text) {
  given_.push_back(text);
  if (verbosity != Verbosity::Quiet) print("hemitex: warning: " + text);
}

void Console::warnings(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) warning(text);
}

void Console::message(const std::string& text) {
  if (verbosity != Verbosity::Quiet) print("hemitex: " + text);
}

void Console::detail(const std::string& text) {
  if (verbosity == Verbosity::Verbose) print("hemitex: " + text);
}

void Console::progress(double fraction, const std::string& text) {
  if (verbosity == Verbosity::Quiet) return;
  const auto now = std::chrono::steady_clock::now();
  if (isatty(STDERR_FILENO) == 0) {
    if (now - shown_ < lineInterval) return;
    detail(text);
    shown_ = now;
    return;
  }
  if (barShown_ && now - shown_ < barInterval) return;
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * barLength);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(barLength - filled), '.');
  std::cerr << "\r\033[K[" << bar << "] " << text << std::flush;
  shown_ = now;
  barShown_ = true;
}

void Console::machineLine(const std::string& text) {
  endProgress();
  std::cerr << text << std::endl;
}

void Console::endProgress() {
  if (barShown_) std::cerr << "\r\033[K" << std::flush;
  barShown_ = false;
}

void Console::print(const std::string& line) {
  endProgress();
  std::cerr << shortened(line, maxLine) << '\n';
}

}  // namespace hemitex::cli
