// The text of an InputError, and its parts.
#include "raster/base/input_error.h"

#include <catch2/catch.hpp>

using hemitex::raster::excerpt;
using hemitex::raster::InputError;

TEST_CASE("InputError joins file, line, problem and advice, without what is missing", "[input_error]") {
  CHECK(std::string(InputError("a.obj", 12, "is wrong", "mend it").what()) == "a.obj:12: is wrong; mend it");
  CHECK(std::string(InputError("a.obj", 1, "is wrong").what()) == "a.obj:1: is wrong");
  CHECK(std::string(InputError("a.obj", 0, "is wrong").what()) == "a.obj: is wrong");
  CHECK(std::string(InputError("is wrong", "mend it").what()) == "is wrong; mend it");
  CHECK(std::string(InputError("is wrong").what()) == "is wrong");
}

TEST_CASE("InputError holds its parts", "[input_error]") {
  const InputError error("a.obj", 12, "is wrong", "mend it");
  CHECK(error.file() == "a.obj");
  CHECK(error.line() == 12);
  CHECK(error.advice() == "mend it");
  CHECK(InputError("is wrong", "mend it").advice() == "mend it");
  CHECK(InputError("is wrong").line() == 0);
}

TEST_CASE("excerpt cuts between characters and shows control characters as question marks", "[input_error]") {
  CHECK(excerpt("a\nb\x1F\x7F c") == "a?b?? c");
  CHECK(excerpt("abcd", 4) == "abcd");
  CHECK(excerpt("abcde", 4) == "abcd...");
  CHECK(excerpt("abc\xC3\xA9", 4) == "abc...");
}

TEST_CASE("InputError has a printable text, but the file as it is", "[input_error]") {
  const InputError error("a\x1B[2J.obj", 3, "names `\xC2\x9B`\n", "mend\xE2\x80\xAE");
  CHECK(std::string(error.what()) == "a?[2J.obj:3: names `?`?; mend?");
  CHECK(error.file() == "a\x1B[2J.obj");
}
