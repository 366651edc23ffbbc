#include "raster/base/short_number.h"

#include <catch2/catch.hpp>

using namespace hemitex::raster;

TEST_CASE("shortNumber has three digits", "[numbers]") {
  CHECK(shortNumber(0.12345) == "0.123");
  CHECK(shortNumber(1e6) == "1e+06");
}

TEST_CASE("parseNumber reads finite decimal numbers and nothing else", "[numbers]") {
  CHECK(parseNumber("0.5") == 0.5);
  CHECK(parseNumber("-1e-3") == -0.001);
  const auto text =
      GENERATE(as<std::string>{}, "", " 5", "5 ", "+5", "nan", "inf", "-infinity", "1e999", "1e-999", "0x10", "0x1p3",
               "\xE2\x88\x92"
               "5",
               "5,0", "1_000", "1'000", "5f", "5\n", "5%", "e5", ".");
  CHECK_FALSE(parseNumber(text));
}

TEST_CASE("toText has the fewest digits that read back to the same number", "[numbers]") {
  CHECK(toText(0.1) == "0.1");
  CHECK(toText(0.1 + 0.2) == "0.30000000000000004");
  CHECK(toText(0.1F) == "0.1");
  CHECK(toText(double{0.1F}) == "0.10000000149011612");
  CHECK(toText(-5.0) == "-5");
}
