/// Lines of the text formats OBJ and MTL: a keyword, then words between blanks. Numbers are read here and nowhere
/// else, correctly rounded to binary64, and what is no finite number is an error with its file and line.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemitex::radiosity {

/// A line that says something: no blank line, no comment.
struct TextLine {
  int number = 0;  ///< counted from 1
  std::string_view keyword;
  std::string_view rest;  ///< what follows it, without blanks at its ends and without a comment
};

/// Where a message points to.
struct Place {
  const std::filesystem::path& file;
  int line = 0;
};

/// Cuts a text at LF, CR LF or CR. A comment begins at a `#` that starts the line or stands alone as a word, so that
/// names such as `wall#1` and `Material #25` stay whole. The views point into `text`.
std::vector<TextLine> splitLines(std::string_view text);

/// Takes the next word off `rest`; nothing at its end or before a word that begins with `#`. For lines of numbers.
std::optional<std::string_view> nextWord(std::string_view& rest);

/// Reads all numbers of `rest` into `numbers` and says how many there are. Throws InputError where a word is no finite
/// number or there are more than `numbers` can hold.
std::size_t readNumbers(std::string_view rest, std::span<double> numbers, const Place& place);

/// Throws InputError.
[[noreturn]] void fail(const Place& place, const std::string& what, const std::string& advice = {});

}  // namespace hemitex::radiosity
