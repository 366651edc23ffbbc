/// Lines and words of text formats such as OBJ and Matrix Market. All numbers of files are parsed here, correctly
/// rounded to double; those below its range are 0. A word that is no finite number is an error with file and line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hemitex::radiosity {

/// A line that is neither blank nor a comment.
struct TextLine {
  int number = 0;            ///< counted from 1
  std::string_view text;     ///< without blanks at its ends and without a comment
  std::string_view keyword;  ///< the first word
  std::string_view rest;     ///< the text behind it
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
  /// The place of the line that was read last; at the end that behind it.
  Place place() const { return {file_, number_}; }

 private:
  std::string_view text_;  ///< what is left
  const std::filesystem::path& file_;
  int number_ = 0;
};

/// The text with lines that end with a backslash joined with the next ones, as OBJ and MTL have them; nothing without
/// such lines. A comment ends with its line. Empty lines behind a joined one keep the numbers of the others.
std::optional<std::string> joinedLines(std::string_view text);

/// Removes the next word from `rest` and returns it; nothing at the end or before a word that begins with `#`. For
/// lines of numbers.
std::optional<std::string_view> nextWord(std::string_view& rest);

/// The number of a word, infinite above the range of binary64; nothing for a word that is no number.
std::optional<double> numberOf(std::string_view word);
/// As numberOf, but throws InputError if the word is no finite number.
double readNumber(std::string_view word, const Place& place);

/// Removes the next word from `rest` and returns it as an integer from 0 to `most`. Throws InputError if it is none.
std::uint64_t takeIndex(std::string_view& rest, std::uint64_t most, const Place& place);

/// Parses all numbers of `rest` into `numbers` and returns how many there are. Throws InputError if a word is no finite
/// number or there are more than `numbers` can hold.
std::size_t readNumbers(std::string_view rest, std::span<double> numbers, const Place& place);

/// Throws InputError.
[[noreturn]] void fail(const Place& place, const std::string& what, const std::string& advice = {});

}  // namespace hemitex::radiosity
