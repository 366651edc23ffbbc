/// What the program says besides its results: messages and progress, all on stderr, so that stdout can be piped.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace hemitex::cli {

enum class Verbosity {
  Quiet,    ///< errors only
  Normal,   ///< warnings and what was done
  Verbose,  ///< how it was done as well
};

class Console {
 public:
  Verbosity verbosity = Verbosity::Normal;

  /// Errors are shown at any verbosity, warnings and messages unless quiet, details only when verbose.
  void error(const std::string& text);
  void warning(const std::string& text);
  void warnings(const std::vector<std::string>& texts);
  void message(const std::string& text);
  void detail(const std::string& text);

  /// Every warning so far, shown or not.
  const std::vector<std::string>& given() const { return given_; }

  /// A bar of `fraction` in [0, 1] with a text behind it; only where stderr is a terminal, and not faster than it
  /// can be read. The next message wipes it.
  void progress(double fraction, const std::string& text);
  /// Wipes the bar.
  void endProgress();

 private:
  void print(const std::string& line);

  std::vector<std::string> given_;
  std::chrono::steady_clock::time_point shown_;  ///< when the bar was last drawn
  bool barShown_ = false;
};

}  // namespace hemitex::cli
