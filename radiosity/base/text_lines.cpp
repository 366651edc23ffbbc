#include "radiosity/base/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

// Plain comparisons: these functions see each character of a file, and std::string_view searches slowly for one of two.
bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

std::string_view trim(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// Removes what stands before the first of some characters from `text`, and returns it.
template <typename IsEnd>
std::string_view takeUntil(const IsEnd& isEnd, std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && !isEnd(text[length])) ++length;
  const std::string_view taken = text.substr(0, length);
  text.remove_prefix(length);
  return taken;
}

std::string_view withoutComment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    const bool startsWord = at == 0 || isBlank(line[at - 1]);
    const bool endsWord = at + 1 == line.size() || isBlank(line[at + 1]);
    if (at == 0 || (startsWord && endsWord)) return trim(line.substr(0, at));
  }
  return line;
}

/// Removes the first line from `text`, with its line end, and returns it.
std::string_view takeLine(std::string_view& text) {
  const std::string_view line = takeUntil(isLineEnd, text);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(text.size(), 1));
  return line;
}

}  // namespace

LineReader::LineReader(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
  if (text_.starts_with(byteOrderMark)) text_.remove_prefix(byteOrderMark.size());
}

std::optional<TextLine> LineReader::next() {
  while (!text_.empty()) {
    ++number_;
    const std::string_view line = withoutComment(trim(takeLine(text_)));
    if (line.empty()) continue;
    if (line.find('\0') != std::string_view::npos)
      fail({file_, number_}, "the line has a NUL byte", "save the file as text in ASCII or UTF-8");
    std::string_view rest = line;
    const std::string_view keyword = takeUntil(isBlank, rest);
    return TextLine{number_, line, keyword, trim(rest)};
  }
  ++number_;
  return std::nullopt;
}

std::optional<std::string> joinedLines(std::string_view text) {
  if (text.find('\\') == text.npos) return std::nullopt;
  std::string joined;
  std::size_t continued = 0;
  while (!text.empty()) {
    std::string_view line = withoutComment(trim(takeLine(text)));
    const bool continues = line.ends_with('\\');
    if (continues) line.remove_suffix(1);
    joined.append(line);
    joined.append(continues ? 1 : std::exchange(continued, 0) + 1, continues ? ' ' : '\n');
    if (continues) ++continued;
  }
  return joined;
}

std::optional<std::string_view> nextWord(std::string_view& rest) {
  rest = trim(rest);
  if (rest.empty() || rest.front() == '#') return {};
  return takeUntil(isBlank, rest);
}

std::optional<double> numberOf(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);  // from_chars accepts no plus sign
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc()) return number;
  const bool isSmall = word.find('-', 1) != word.npos;  // a minus sign of the exponent
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return isSmall ? 0 : word.front() == '-' ? -infinity : infinity;
}

double readNumber(std::string_view word, const Place& place) {
  const std::optional<double> number = numberOf(word);
  // The sum turns -0 into 0, so that equal numbers have equal bits.
  if (number && std::isfinite(*number)) return *number + 0.0;
  const bool isName = word.find_first_of("0123456789") == word.npos;  // such as inf
  fail(place, "'" + raster::excerpt(word) + "' is " +
                  (!number  ? "not a number"
                   : isName ? "not a finite number"
                            : "outside the range of binary64"));
}

std::uint64_t takeIndex(std::string_view& rest, std::uint64_t most, const Place& place) {
  const auto word = nextWord(rest);
  if (!word) fail(place, "an integer from 0 to " + std::to_string(most) + " is missing");
  const auto index = raster::parseInteger<std::uint64_t>(*word);
  if (!index || *index > most)
    fail(place, "'" + raster::excerpt(*word) + "' is not an integer from 0 to " + std::to_string(most));
  return *index;
}

std::size_t readNumbers(std::string_view rest, std::span<double> numbers, const Place& place) {
  std::size_t count = 0;
  for (auto word = nextWord(rest); word; word = nextWord(rest)) {
    const double number = readNumber(*word, place);
    if (count == numbers.size()) fail(place, "'" + raster::excerpt(*word) + "' is one number too many");
    numbers[count++] = number;
  }
  return count;
}

void fail(const Place& place, const std::string& what, const std::string& advice) {
  throw raster::InputError(place.file.string(), place.line, what, advice);
}

}  // namespace hemitex::radiosity
