/// Reads the words and numbers of a text file line by line. The file need not fit into memory, nor need a line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "raster/base/file_io.h"

namespace hemitex::reference {

class WordReader {
 public:
  /// Words are separated by blanks, tabs, commas and semicolons. Throws InputError as raster::openFile.
  explicit WordReader(const std::filesystem::path& file);

  /// Goes to the next line, the first one at the first call; false at the end of the file.
  bool nextLine();
  /// The next word of the line, valid until the next call; nothing at the end of the line.
  std::optional<std::string_view> word();
  /// The next word of the line. Throws InputError if there is none; `what` names it for the message.
  std::string_view word(const char* what);
  /// The next word of the line as a finite number. Throws InputError if it is none.
  double number(const char* what);
  /// The next word of the line as an integer from 0 to `most`. Throws InputError if it is none.
  std::uint64_t index(const char* what, std::uint64_t most);
  /// Throws InputError if the line has another word.
  void endLine();

  /// Throws InputError for the line.
  [[noreturn]] void fail(const std::string& what, const std::string& advice = {}) const;

 private:
  bool fill();
  void skip(std::string_view characters);

  std::filesystem::path file_;
  raster::InputFile stream_;
  std::string block_;  ///< read and not yet taken, from at_ on
  std::size_t at_ = 0;
  std::int64_t line_ = 0;  ///< counted from 1; 0 before the first one
};

/// Parses a finite number, correctly rounded; nothing for any other word.
std::optional<double> finiteNumber(std::string_view word);
/// Parses an integer of digits alone; nothing for any other word.
std::optional<std::uint64_t> wholeNumber(std::string_view word);

}  // namespace hemitex::reference
