#include "raster/base/name_suggestions.h"

#include <catch2/catch.hpp>
#include <chrono>

using hemitex::raster::nearestNames;

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

TEST_CASE("nearestNames takes linear time for long names and for many", "[suggestions]") {
  std::set<std::string> names;
  for (int i = 0; i < 16000; ++i) names.insert("node " + std::to_string(i) + std::string(200, 'x'));
  const auto begin = std::chrono::steady_clock::now();
  nearestNames(names, std::string(40000, 'y'));
  nearestNames({std::string(400000, 'x'), std::string(400000, 'z')}, std::string(400000, 'y'));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(1));  // 0.1 s; by all pairs of letters minutes
}
