// Culling clusters before the vertex stage changes no pixel.
#include "raster/culling/triangle_cluster.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "raster/culling/frustum_culling.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;
using tests::addTriangle;
using tests::plainList;

namespace {

/// Draws around the eye, some of them through it, each with `triangles` triangles near to each other.
DrawList cloud(int draws, int triangles, unsigned seed) {
  DrawList list = plainList();
  std::mt19937 random(seed);
  const auto point = [&](float size) {
    return glm::vec3(tests::uniform(random, -size, size), tests::uniform(random, -size, size),
                     tests::uniform(random, -size, size));
  };
  for (int draw = 0; draw < draws; ++draw) {
    tests::addDraw(list, static_cast<ItemId>(draw));
    const glm::vec3 centre = point(4);
    const float size = 0.01F * static_cast<float>(1U << (random() % 9));
    for (int t = 0; t < triangles; ++t)
      addTriangle(list, {centre + point(size), centre + point(size), centre + point(size)});
  }
  return list;
}

/// Draws of two triangles each, side by side in a row.
DrawList row(int draws) {
  DrawList list = plainList();
  for (int draw = 0; draw < draws; ++draw) {
    tests::addDraw(list, static_cast<ItemId>(draw));
    const auto x = static_cast<float>(draw);
    addTriangle(list, {{x, 0, 9}, {x + 1, 0, 9}, {x + 1, 1, 9}});
    addTriangle(list, {{x, 0, 9}, {x + 1, 1, 9}, {x, 1, 9}});
  }
  return list;
}

/// The same draws with an index map.
DrawList withMap(DrawList list) {
  list.indexMaps.push_back({1, 1, {0}});
  for (Draw& draw : list.draws) draw.indexMap = 0;
  return list;
}

Scissor randomScissor(std::mt19937& random, int resolution) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int column = below(resolution), row = below(resolution);
  return {column, row, 1 + below(resolution - column), 1 + below(resolution - row)};
}

}  // namespace

TEST_CASE("clustersOf covers the triangles of the draws in order, each once", "[cluster]") {
  for (const DrawList& list : {cloud(10, 100, 1), withMap(cloud(10, 100, 1)), cloud(500, 2, 4)}) {
    std::uint32_t next = 0;
    for (const Cluster& cluster : clustersOf(list))
      for (const TriangleRun& run : cluster.runs) {
        CHECK(run.first == next);
        next = run.end;
        for (std::size_t i = 3 * std::size_t{run.first}; i < 3 * std::size_t{run.end}; ++i) {
          const glm::dvec3 p(list.positions[list.indices[i]]);
          CHECK(
              (glm::all(glm::lessThanEqual(cluster.box.low, p)) && glm::all(glm::lessThanEqual(p, cluster.box.high))));
        }
      }
    CHECK(next == 1000);
  }
}

TEST_CASE("clustersOf puts draws side by side into clusters of 32 triangles, if they have at most one map",
          "[cluster]") {
  CHECK(clustersOf(row(500)).size() == 32);
  DrawList list = withMap(row(500));
  CHECK(clustersOf(list).size() == 32);
  for (const Cluster& cluster : clustersOf(list)) CHECK(cluster.indexMap == 0);
  // Draws without a map fit to any.
  for (std::size_t i = 0; i < 500; i += 3) list.draws[i].indexMap = std::nullopt;
  CHECK(clustersOf(list).size() == 32);
  // Ten draws with one map, and ten with another.
  list.indexMaps.push_back({1, 1, {0}});
  for (std::size_t i = 0; i < 500; ++i) list.draws[i].indexMap = static_cast<int>(i / 10 % 2);
  const std::vector<Cluster> clusters = clustersOf(list);
  CHECK(clusters.size() == 50);
  for (const Cluster& cluster : clusters)
    for (const TriangleRun& run : cluster.runs) CHECK(list.draws[run.draw].indexMap == cluster.indexMap);
}

TEST_CASE("clustersOf separates draws that are far from each other", "[cluster]") {
  DrawList list = row(500);
  for (std::size_t i = 0; i < list.positions.size(); ++i)
    if (i / 6 % 2 == 1) list.positions[i].y += 1000;
  CHECK(clustersOf(list).size() == 500);
}

TEST_CASE("ViewBounds culls only clusters without screen triangles, and most of those", "[cluster]") {
  std::mt19937 random(7);
  int without = 0, leftOut = 0;
  for (const DrawList& list : {withMap(cloud(1000, 1, 2)), cloud(30, 70, 3)}) {
    const std::vector<Cluster> clusters = clustersOf(list);
    for (int view = 0; view < 40; ++view) {
      Face face = tests::frontFace(view % 2 == 0 ? 64 : 4096);
      face.nearDistance = 0.001F * static_cast<float>(1 + random() % 100);
      if (view % 3 == 0) face.x *= -2.0F;
      if (view % 5 == 0) std::swap(face.y, face.w);
      face.scissor = randomScissor(random, face.resolution);
      for (const Cluster& cluster : clusters) {
        std::vector<ScreenTriangle> triangles;
        appendScreenTriangles(list, face, cluster.runs, {}, triangles);
        const bool looksAt = ViewBounds(face).mayShow(cluster.box);
        if (!triangles.empty()) CHECK(looksAt);
        without += triangles.empty() ? 1 : 0;
        leftOut += looksAt ? 0 : 1;
      }
    }
  }
  // Boxes extend beyond triangles, so that only a share is culled: more than three quarters.
  CHECK(leftOut > without * 3 / 4);
  CHECK(leftOut <= without);
}

TEST_CASE("ViewBounds never culls a cluster with a value that is not finite", "[cluster]") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float value : {infinity, -infinity, nan, 2e15F}) {
    DrawList list = plainList();
    tests::addDraw(list, 1);
    addTriangle(list, {{0, 0, -9}, {1, 0, -9}, {0, value, -9}});
    CHECK(ViewBounds(tests::frontFace(8)).mayShow(clustersOf(list).front().box));
  }
}
