/// The exception for wrong user input. It holds the file, the line, the problem and an advice. All parts of the library
/// throw it; only the program catches it, prints what() and exits with 2. Internal faults are assertions, never an
/// InputError.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace hemitex::raster {

/// Input as messages quote it: at most `maxBytes` bytes, printable (printable_text.h), with `...` where it is cut.
std::string excerpt(std::string_view text, std::size_t maxBytes = 200);

class InputError : public std::runtime_error {
 public:
  /// `what` states the problem; `advice` states what to do and may be empty. The text of what() is printable
  /// (printable_text.h), in one line.
  explicit InputError(const std::string& what, const std::string& advice = {});
  /// As above, for a place in a file. `line` counts from 1; 0 means no line.
  InputError(const std::string& file, int line, const std::string& what, const std::string& advice = {});

  const std::string& file() const { return file_; }
  int line() const { return line_; }
  const std::string& advice() const { return advice_; }

 private:
  std::string file_;
  int line_ = 0;
  std::string advice_;
};

}  // namespace hemitex::raster
