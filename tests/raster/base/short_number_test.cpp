#include "raster/base/short_number.h"

#include <catch2/catch.hpp>

using namespace hemitex::raster;

TEST_CASE("shortNumber has three digits", "[numbers]") {
  CHECK(shortNumber(0.12345) == "0.123");
  CHECK(shortNumber(1e6) == "1e+06");
}

TEST_CASE("toText has the fewest digits that read back to the same number", "[numbers]") {
  CHECK(toText(0.1) == "0.1");
  CHECK(toText(0.1 + 0.2) == "0.30000000000000004");
  CHECK(toText(0.1F) == "0.1");
  CHECK(toText(double{0.1F}) == "0.10000000149011612");
  CHECK(toText(-5.0) == "-5");
}
