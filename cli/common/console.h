/// Messages and progress of the program. All go to stderr, so that stdout holds only results and can be piped.
#pragma once

#include <chrono>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

namespace hemitex::cli {

enum class Verbosity {
  Quiet,    ///< errors only
  Normal,   ///< errors, warnings and messages
  Verbose,  ///< also details
};

/// The text with `...` in its middle where it has more than `maxBytes` bytes, so that long input does not flood a
/// terminal.
std::string shortened(const std::string& text, std::size_t maxBytes);

/// The text in single quotes, which sh, bash and zsh read as one word, so that a person can copy a suggested command.
std::string shellQuoted(const std::string& text);

/// Messages are printable (raster/base/printable_text.h), each in one line.
class Console {
 public:
  Verbosity verbosity = Verbosity::Normal;

  /// Prints a line, if the verbosity allows it; the advice of an error is a second one.
  void error(const std::string& text, const std::string& advice = {});
  void warning(const std::string& text);
  void warnings(const std::vector<std::string>& texts);
  void message(const std::string& text);
  void detail(const std::string& text);

  /// All warnings so far, printed or not.
  const std::vector<std::string>& given() const { return given_; }

  /// Shows a progress bar of `fraction` in [0, 1] with a text if stderr is a terminal. The bar changes at most every
  /// 0.1 s. The next message removes it. Elsewhere prints the text as a detail, at most every 10 s.
  void progress(double fraction, const std::string& text);
  /// Prints a line for programs, whatever the verbosity.
  void machineLine(const std::string& text);
  /// Removes the bar.
  void endProgress();

 private:
  void print(const std::string& line);

  std::vector<std::string> given_;
  std::chrono::steady_clock::time_point shown_;  ///< when the progress was last shown
  bool barShown_ = false;
};

/// While it exists, what a stream writes is printable, with line ends and tabs: names of files and what devices say
/// cannot control the terminal. All that goes to the standard output passes here.
class PrintableStream : public std::streambuf {
 public:
  /// `stream` must outlive this object.
  explicit PrintableStream(std::ostream& stream);
  ~PrintableStream() override;
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int_type overflow(int_type character) override;
  int sync() override;
  bool write(std::size_t size);

  std::ostream& stream_;
  std::streambuf* target_;
  std::string text_;  ///< not written yet: a character may go on in the next part
};

}  // namespace hemitex::cli
