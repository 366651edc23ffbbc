// Lines, words and numbers of text files.
#include "radiosity/base/text_lines.h"

#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "raster/base/input_error.h"

using namespace hemitex;
using namespace hemitex::radiosity;

TEST_CASE("numberOf reads words of all sizes: those below the range of binary64 are 0", "[text_lines]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(numberOf("+0.1") == 0.1);
  CHECK(numberOf("4.9e-324") == std::numeric_limits<double>::denorm_min());
  CHECK(numberOf("1e-999") == 0);
  CHECK(numberOf("-1E-999") == 0);
  CHECK(numberOf("1e999") == infinity);
  CHECK(numberOf("-1e999") == -infinity);
  for (const char* word : {"", "+", "+-1", "1e", "0x1", "1,5", "1 "}) CHECK_FALSE(numberOf(word));
}

TEST_CASE("takeIndex takes an integer in its range from a line, and names any other word", "[text_lines]") {
  const std::filesystem::path file = "a.txt";
  std::string_view rest = " 7 4294967296 x";
  CHECK(takeIndex(rest, 7, {file, 2}) == 7);
  CHECK(takeIndex(rest, 1ULL << 40, {file, 2}) == 4294967296);
  for (const auto& [text, what] : {std::pair("8", "a.txt:2: '8' is not an integer from 0 to 7"),
                                   {"-1", "a.txt:2: '-1' is not an integer from 0 to 7"},
                                   {"1.0", "a.txt:2: '1.0' is not an integer from 0 to 7"},
                                   {" ", "a.txt:2: an integer from 0 to 7 is missing"}}) {
    std::string_view words = text;
    CHECK_THROWS_WITH(takeIndex(words, 7, {file, 2}), what);
  }
}

TEST_CASE("LineReader::place is that of the line that was read, and behind the last one at the end", "[text_lines]") {
  const std::filesystem::path file = "a.txt";
  LineReader lines("\xEF\xBB\xBF# comment\n\na b # c\rd\n", file);
  CHECK(lines.next()->text == "a b");
  CHECK(lines.place().line == 3);
  CHECK(lines.next()->text == "d");
  CHECK_FALSE(lines.next());
  CHECK(lines.place().line == 5);
}
