#include "raster/base/name_suggestions.h"

#include <catch2/catch.hpp>

using hemitex::raster::nearestNames;

TEST_CASE("nearestNames orders names by edit distance, then by alphabet, and gives at most three", "[suggestions]") {
  CHECK(nearestNames({}, "floor").empty());
  CHECK(nearestNames({"wall"}, "floor") == "`wall`");
  // Distances of `flor`: 1 (insert), 0, 2 (insert, change), 4 (change all).
  CHECK(nearestNames({"floor", "flor", "flooy", "wall"}, "flor") == "`flor`, `floor`, `flooy`");
  // Distances of `abc`: 1 (delete), 1 (change), 1 (insert), 3 (delete all).
  CHECK(nearestNames({"", "ab", "abd", "abcd"}, "abc") == "`ab`, `abcd`, `abd`");
}
