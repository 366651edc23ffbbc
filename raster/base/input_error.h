/// The one exception that means "the user's input is wrong": a file, a line where there is one, what is wrong and
/// what to do about it. It is thrown by every room of the library and caught once, by the program, which prints
/// what() and exits with 2. Our own faults are assertions, never an InputError.
#pragma once

#include <stdexcept>
#include <string>

namespace hemitex::raster {

class InputError : public std::runtime_error {
 public:
  /// `what` says what is wrong, `advice` what to do (may be empty).
  explicit InputError(const std::string& what, const std::string& advice = {});
  /// The same for a place in a file; `line` counts from 1, 0 where there is none.
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
