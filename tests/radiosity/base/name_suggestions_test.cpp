#include "radiosity/base/name_suggestions.h"

#include <catch2/catch.hpp>

using hemitex::radiosity::nearestNames;

TEST_CASE("nearestNames orders names by edit distance, then by alphabet, and gives at most three", "[suggestions]") {
  CHECK(nearestNames({}, "floor").empty());
  CHECK(nearestNames({"wall"}, "floor") == "`wall`");
  // Distances of `flor`: 1 (insert), 0, 2 (insert, change), 4 (change all).
  CHECK(nearestNames({"floor", "flor", "flooy", "wall"}, "flor") == "`flor`, `floor`, `flooy`");
  // Distances of `abc`: 1 (delete), 1 (change), 1 (insert), 3 (delete all).
  CHECK(nearestNames({"", "ab", "abd", "abcd"}, "abc") == "`ab`, `abcd`, `abd`");
}

TEST_CASE("nearestNames finds a name that differs behind a long beginning", "[suggestions]") {
  const std::string path(1000, 'a'), rest(1000, 'b');
  CHECK(nearestNames({path + "window" + rest, path + "wall" + rest, path + "door" + rest, "x"}, path + "windw" + rest)
            .starts_with("`aaa"));
  CHECK(nearestNames({"group/room 1/door", "group/room 1/wall", "group/room 2/wall", "other"}, "group/room 1/wal") ==
        "`group/room 1/wall`, `group/room 2/wall`, `group/room 1/door`");
}

// Comparing all pairs of letters would take minutes.
TEST_CASE("nearestNames answers for names of 400,000 letters and for 16,000 names", "[suggestions]") {
  std::set<std::string> names;
  for (int i = 0; i < 16000; ++i) names.insert("node " + std::to_string(i) + std::string(200, 'x'));
  CHECK(nearestNames(names, std::string(40000, 'y')).starts_with("`node "));
  CHECK(
      nearestNames({std::string(400000, 'x'), std::string(400000, 'z')}, std::string(400000, 'y')).starts_with("`xxx"));
}
