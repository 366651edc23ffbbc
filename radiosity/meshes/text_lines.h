/// Lines of text formats such as OBJ: a keyword, then words separated by blanks. All numbers are parsed here,
/// correctly rounded to double. A word that is no finite number is an error with file and line.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hemitex::radiosity {

/// A line that is neither blank nor a comment.
struct TextLine {
  int number = 0;  ///< counted from 1
  std::string_view keyword;
  std::string_view rest;  ///< the text behind the keyword, without blanks at its ends and without a comment
};

/// The place that an error message names.
struct Place {
  const std::filesystem::path& file;
  int line = 0;
};

/// Splits a text at LF, CR LF or CR. A comment begins at a `#` at the start of the line or at a `#` that is a word of
/// its own. So names such as `wall#1` and `Material #25` stay whole. The views point into the text.
class LineReader {
 public:
  /// Both arguments must outlive this object.
  LineReader(std::string_view text, const std::filesystem::path& file);

  /// The next line; nothing at the end. Throws InputError for a line with a NUL byte, which would end a name.
  std::optional<TextLine> next();

 private:
  std::string_view text_;  ///< what is left
  const std::filesystem::path& file_;
  int number_ = 0;  ///< of the last line
};

/// Removes the next word from `rest` and returns it; nothing at the end or before a word that begins with `#`. For
/// lines of numbers.
std::optional<std::string_view> nextWord(std::string_view& rest);

/// Parses all numbers of `rest` into `numbers` and returns how many there are. Throws InputError if a word is no finite
/// number or there are more than `numbers` can hold.
std::size_t readNumbers(std::string_view rest, std::span<double> numbers, const Place& place);

/// Throws InputError.
[[noreturn]] void fail(const Place& place, const std::string& what, const std::string& advice = {});

}  // namespace hemitex::radiosity
