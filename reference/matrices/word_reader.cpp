#include "reference/matrices/word_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

constexpr std::size_t blockBytes = std::size_t{1} << 20;
constexpr std::string_view blanks = " \t,;";
constexpr std::string_view ends = " \t,;\r\n";

}  // namespace

WordReader::WordReader(const std::filesystem::path& file)
    : file_(file), stream_(raster::openFile(file, "check the path, and that it is a file you may read")) {}

/// Reads more behind what is left; false at the end of the file.
bool WordReader::fill() {
  block_.erase(0, at_);
  at_ = 0;
  const std::size_t left = block_.size();
  block_.resize(left + blockBytes);
  block_.resize(left + std::fread(block_.data() + left, 1, blockBytes, stream_.get()));
  return block_.size() > left;
}

void WordReader::skip(std::string_view characters) {
  do {
    at_ = std::min(block_.find_first_not_of(characters, at_), block_.size());
  } while (at_ == block_.size() && fill());
}

bool WordReader::nextLine() {
  if (line_++ > 0) {
    do {
      at_ = std::min(block_.find('\n', at_), block_.size());
    } while (at_ == block_.size() && fill());
    at_ = std::min(at_ + 1, block_.size());
  }
  return at_ < block_.size() || fill();
}

std::optional<std::string_view> WordReader::word() {
  skip(blanks);
  std::size_t end = block_.find_first_of(ends, at_);
  while (end == std::string::npos && block_.size() - at_ < blockBytes && fill()) end = block_.find_first_of(ends, at_);
  const std::string_view found = std::string_view(block_).substr(at_, std::min(end, block_.size()) - at_);
  at_ += found.size();
  return found.empty() ? std::nullopt : std::optional(found);
}

std::string_view WordReader::word(const char* what) {
  const auto found = word();
  if (!found) fail(std::string("the line ends before ") + what);
  return *found;
}

double WordReader::number(const char* what) {
  const std::string_view text = word(what);
  const auto number = finiteNumber(text);
  if (!number) fail("'" + raster::excerpt(text) + "' is not a finite number, as " + what + " must be");
  return *number;
}

std::uint64_t WordReader::index(const char* what, std::uint64_t most) {
  const std::string_view text = word(what);
  const auto number = wholeNumber(text);
  if (!number || *number > most)
    fail("'" + raster::excerpt(text) + "' is not an integer from 0 to " + std::to_string(most) + ", as " + what +
         " must be");
  return *number;
}

void WordReader::endLine() {
  if (const auto more = word()) fail("'" + raster::excerpt(*more) + "' is one word too many");
}

void WordReader::fail(const std::string& what, const std::string& advice) const {
  const auto line = static_cast<int>(std::min<std::int64_t>(line_, std::numeric_limits<int>::max()));
  throw raster::InputError(file_.string(), line, what, advice);
}

std::optional<double> finiteNumber(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);  // from_chars accepts no plus sign
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  // Numbers below the range of binary64, which some programs write, are 0.
  if (error == std::errc::result_out_of_range && end == word.data() + word.size() && word.find("e-") != word.npos)
    return 0.0;
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<std::uint64_t> wholeNumber(std::string_view word) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace hemitex::reference
