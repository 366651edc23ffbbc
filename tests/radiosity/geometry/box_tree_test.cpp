// A search of all boxes is the truth for the tree.
#include "radiosity/geometry/box_tree.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace hemitex::radiosity;

TEST_CASE("BoxTree::find gives the boxes that meet a box, also after add and remove", "[geometry]") {
  std::mt19937 random(5);
  const auto draw = [&](int count) { return static_cast<double>(random() % static_cast<unsigned>(count)); };
  const auto anyBox = [&] {
    const glm::dvec2 low(draw(40), draw(40));  // integers, so that many boxes only touch
    return PlaneBox{low, low + glm::dvec2(draw(4), draw(4))};
  };
  std::vector<PlaneBox> boxes;
  for (int i = 0; i < 300; ++i) boxes.push_back(anyBox());
  BoxTree tree(boxes);
  std::vector<bool> isThere(boxes.size(), true);
  std::size_t foundInAll = 0;
  for (int step = 0; step < 1000; ++step) {
    const std::size_t changed = random() % boxes.size();
    if (isThere[changed]) tree.remove(boxes[changed], static_cast<std::uint32_t>(changed));
    if (step % 2 == 0) boxes[changed] = anyBox();
    isThere[changed] = step % 5 != 0;
    if (isThere[changed]) tree.add(boxes[changed], static_cast<std::uint32_t>(changed));
    const PlaneBox searched = anyBox();
    std::vector<std::uint32_t> expected, found{7};
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      if (isThere[i] && meet(boxes[i], searched)) expected.push_back(i);
    tree.find(searched, found);
    REQUIRE(found == expected);
    foundInAll += found.size();
  }
  CHECK(foundInAll > 1000);
}
