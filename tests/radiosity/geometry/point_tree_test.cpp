// A search of all points is the truth for the tree.
#include "radiosity/geometry/point_tree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace hemitex::radiosity;

TEST_CASE("PointTree::find finds a point in a box if and only if one is left there", "[geometry]") {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> coordinate(0, 30);  // many points coincide
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 700; ++i) points.emplace_back(coordinate(random), coordinate(random));
  PointTree tree(points);
  std::vector<std::uint32_t> left(points.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
  std::shuffle(left.begin(), left.end(), random);
  int found = 0, missing = 0;
  while (!left.empty()) {
    const glm::dvec2 low(coordinate(random), coordinate(random)), high = low + glm::dvec2(coordinate(random) % 4);
    const auto isInside = [&](std::uint32_t i) {
      return points[i].x >= low.x && points[i].x <= high.x && points[i].y >= low.y && points[i].y <= high.y;
    };
    const auto meets = [&](const glm::dvec2& from, const glm::dvec2& to) {
      return from.x <= high.x && to.x >= low.x && from.y <= high.y && to.y >= low.y;
    };
    const auto point = tree.find(meets, isInside);
    const bool isExpected = std::any_of(left.begin(), left.end(), isInside);
    REQUIRE(point.has_value() == isExpected);
    if (point) REQUIRE((isInside(*point) && std::find(left.begin(), left.end(), *point) != left.end()));
    ++(point ? found : missing);
    tree.remove(left.back());
    left.pop_back();
  }
  CHECK(found > 100);
  CHECK(missing > 100);
  CHECK_FALSE(tree.find([](auto&&...) { return true; }, [](std::uint32_t) { return true; }));
}
