// Names that occur several times get numbers.
#include "radiosity/base/unique_names.h"

#include <catch2/catch.hpp>
#include <chrono>

using hemitex::radiosity::UniqueNames;

TEST_CASE("UniqueNames numbers names that are taken", "[names]") {
  UniqueNames names;
  names.take("wall~3");
  names.take("wall~3");
  CHECK(names.add("wall") == "wall");
  CHECK(names.add("wall") == "wall~2");
  CHECK(names.add("wall") == "wall~4");
  CHECK(names.add("wall~2") == "wall~2~2");
  CHECK(names.add("wall~3") == "wall~3~2");
  CHECK(names.add("") == "");
  CHECK(names.add("") == "~2");
}

TEST_CASE("UniqueNames takes linear time for one name", "[names]") {
  const auto start = std::chrono::steady_clock::now();
  UniqueNames names;
  for (int n = 0; n < 200'000; ++n) names.add("node");
  CHECK(names.add("node") == "node~200001");
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));  // quadratic: minutes
}
