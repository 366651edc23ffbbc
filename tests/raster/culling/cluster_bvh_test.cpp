// ClusterBvh::groupsIn finds the same groups as a test of each group.
#include "raster/culling/cluster_bvh.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

/// `count` clusters of one triangle each, because consecutive draws have different maps. One in twenty has an infinite
/// box.
std::vector<Cluster> scattered(std::size_t count) {
  DrawList list = tests::plainList();
  list.indexMaps.resize(2, {1, 1, {0}});
  std::mt19937 random(4);
  for (std::size_t i = 0; i < count; ++i) {
    const auto near = [&](const glm::vec3& p, float size) {
      return p + glm::vec3(tests::uniform(random, -size, size), tests::uniform(random, -size, size),
                           tests::uniform(random, -size, size));
    };
    tests::addDraw(list, 1, {}, static_cast<int>(i % 2));
    const glm::vec3 centre = near({0, 0, 0}, 9);
    const float far = i % 20 == 7 ? std::numeric_limits<float>::infinity() : 1;
    tests::addTriangle(list, {centre, near(centre, 1), far * near(centre, 1)});
  }
  return clustersOf(list);
}

bool isInside(const Box& inner, const Box& outer) {
  return glm::min(inner.low, outer.low) == outer.low && glm::max(inner.high, outer.high) == outer.high;
}

}  // namespace

TEST_CASE("ClusterBvh finds the groups of clusters that may cover a sample, in draw order", "[cluster_tree]") {
  for (const std::uint32_t count : {0, 1, 7, 8, 9, 64, 65, 1000}) {
    const std::vector<Cluster> clusters = scattered(count);
    REQUIRE(clusters.size() == count);
    const ClusterBvh tree(clusters);
    const std::uint32_t groups = (count + 7) / 8;
    for (std::uint32_t g = 0; g < groups; ++g) {
      const ClusterGroup& group = tree.group(g);
      CHECK(group.first == 8 * g);
      CHECK(group.end == std::min(8 * (g + 1), count));
      for (std::uint32_t c = group.first; c < group.end; ++c) CHECK(isInside(clusters[c].box, group.box));
    }
    for (Face face : tests::threeFaces())
      for (const int width : {64, 8, 1}) {
        face.scissor.width = width;
        const ViewBounds view(face);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t g = 0; g < groups; ++g)
          if (view.mayShow(tree.group(g).box)) expected.push_back(g);
        CHECK(tree.groupsIn(view) == expected);
      }
  }
}
