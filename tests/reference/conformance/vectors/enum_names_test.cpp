// Tables of names: each name reads back to its value.
#include "reference/conformance/vectors/enum_names.h"

#include <catch2/catch.hpp>

#include "reference/conformance/verdict/error_pixel.h"
#include "reference/conformance/verdict/pixel_judge.h"

using namespace hemitex;
using reference::errorKindNames;
using reference::pixelVerdictNames;

TEST_CASE("valueOf reads what nameOf writes, and refuses other names", "[vectors]") {
  for (const auto& [verdict, name] : pixelVerdictNames) {
    CHECK(nameOf(pixelVerdictNames, verdict) == name);
    CHECK(valueOf(pixelVerdictNames, name, "verdict") == verdict);
  }
  CHECK_THROWS_WITH(valueOf(pixelVerdictNames, "exactly", "verdict"),
                    "\"verdict\" is \"exactly\"; use one of exact, coverage, texel, depth, loose-clipping, error");
}

TEST_CASE("pixelVerdictNames and errorKindNames are in the order of their enums", "[vectors]") {
  for (std::size_t k = 0; k < pixelVerdictNames.size(); ++k)
    CHECK(static_cast<std::size_t>(pixelVerdictNames[k].value) == k);
  for (std::size_t k = 0; k < errorKindNames.size(); ++k) CHECK(static_cast<std::size_t>(errorKindNames[k].value) == k);
}
