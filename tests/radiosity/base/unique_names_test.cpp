// Names that occur several times get numbers.
#include "radiosity/base/unique_names.h"

#include <catch2/catch.hpp>

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

TEST_CASE("UniqueNames numbers 200,000 equal names", "[names]") {
  UniqueNames names;
  for (int n = 0; n < 200'000; ++n) names.add("node");
  CHECK(names.add("node") == "node~200001");
}
