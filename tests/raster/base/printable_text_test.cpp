#include "raster/base/printable_text.h"

#include <catch2/catch.hpp>

using hemitex::raster::printable;
using hemitex::raster::printableJson;

TEST_CASE("printable keeps text, and replaces what controls a terminal or the direction of text", "[printable]") {
  const std::string text = "wall #1 \xC3\xA9 \xE4\xB8\xAD \xF0\x9F\x98\x80 ~\xC2\xA0";
  CHECK(printable(text) == text);
  CHECK(printable("\x1B[2Ja\rb\x7F") == "?[2Ja?b?");
  CHECK(printable("a\xC2\x9B"
                  "b\xC2\x80\xC2\x9F") == "a?b??");
  CHECK(printable("a\xE2\x80\xAE"
                  "b\xE2\x80\xAA\xE2\x81\xA6\xE2\x81\xA9\xE2\x80\x8E\xD8\x9C") == "a?b?????");
  CHECK(printable("\xE2\x80\x90\xE2\x81\xA5") == "\xE2\x80\x90\xE2\x81\xA5");
  CHECK(printable(std::string(1, '\0')) == "?");
  CHECK(printable("").empty());
}

TEST_CASE("printable replaces each byte that is not UTF-8", "[printable]") {
  CHECK(printable("W\xE4nde") == "W?nde");
  CHECK(printable("\x80\x9B") == "??");
  CHECK(printable("\xC0\x9B") == "??");            // an overlong U+001B
  CHECK(printable("\xE0\x80\x9B") == "???");       // an overlong U+001B
  CHECK(printable("\xED\xA0\x80") == "???");       // a surrogate
  CHECK(printable("\xF4\x90\x80\x80") == "????");  // above U+10FFFF
  CHECK(printable("\xFF") == "?");
  CHECK(printable("abc\xE2\x80") == "abc??");  // cut off
}

TEST_CASE("printable keeps the control characters in `kept`", "[printable]") {
  CHECK(printable("a\tb\nc\r", "\n\t") == "a\tb\nc?");
}

TEST_CASE("printableJson escapes, so that the values stay", "[printable]") {
  CHECK(printableJson("{\n  \"a\x7F\xC2\x9B\xE2\x80\xAE\": 1}") == "{\n  \"a\\u007f\\u009b\\u202e\": 1}");
}
