// A search of all boxes is the truth for the hierarchy.
#include "radiosity/geometry/nearest_boxes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <vector>

using namespace hemitex::radiosity;

TEST_CASE("NearestBoxes::visit finds the nearest box, and visits few others", "[geometry]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return glm::dvec3{coordinate(random), coordinate(random), coordinate(random)}; };
  for (const std::size_t count : {0, 1, 8, 9, 3000}) {
    std::vector<SpaceBox> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 middle = point(), half = 0.05 * glm::abs(point());
      boxes.push_back({middle - half, middle + half});
    }
    const NearestBoxes hierarchy(boxes);
    std::size_t visits = 0;
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 from = 1.5 * point();
      double expected = std::numeric_limits<double>::infinity(), nearest = expected;
      for (const SpaceBox& box : boxes) expected = std::min(expected, squaredDistance(from, box));
      hierarchy.visit(from, nearest, [&](std::uint32_t number, double& limit) {
        limit = std::min(limit, squaredDistance(from, boxes[number]));
        ++visits;
      });
      CHECK(nearest == expected);
    }
    CHECK(visits <= 100 * std::min<std::size_t>(count, 64));
  }
}

TEST_CASE("NearestBoxes::visit visits each box within a limit once", "[geometry]") {
  std::vector<SpaceBox> boxes;
  for (int i = 0; i < 1000; ++i) boxes.push_back({glm::dvec3(i, 0, 0), glm::dvec3(i + 0.5, 1, 1)});
  std::vector<int> visits(boxes.size());
  double limit = 100.0 * 100.0;
  NearestBoxes(boxes).visit({500.25, 0.5, 0.5}, limit, [&](std::uint32_t number, double&) { ++visits[number]; });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    CHECK(visits[i] <= 1);
    if (squaredDistance({500.25, 0.5, 0.5}, boxes[i]) < limit) CHECK(visits[i] == 1);
  }
}
