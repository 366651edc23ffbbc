// Triangles of strips, fans, restarts and instances, and pairs as numbers.
#include "raster/interface/assembly.h"

#include <catch2/catch.hpp>

#include "raster/base/input_error.h"

using namespace hemitex::raster;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A list of `vertices` vertices at (i, 0, 1) with a draw of all indices.
DrawList listOf(const std::vector<std::uint32_t>& indices, Topology topology, std::uint32_t vertices = 10) {
  DrawList list;
  list.format = {{32}};
  for (std::uint32_t v = 0; v < vertices; ++v) list.positions.emplace_back(v, 0, 1);
  list.texcoords.resize(vertices);
  list.indices = indices;
  list.draws.push_back({.count = static_cast<std::uint32_t>(indices.size()), .back = {}});
  list.draws[0].topology = topology;
  return list;
}

Triangles trianglesOf(const DrawList& list) { return trianglesOf(list, list.draws[0]); }

}  // namespace

TEST_CASE("trianglesOf turns every other triangle of a strip, and keeps the provoking vertex", "[assembly]") {
  DrawList list = listOf({4, 5, 6, 7, 8}, Topology::Strip);
  CHECK(trianglesOf(list) == Triangles{{4, 5, 6}, {5, 7, 6}, {6, 7, 8}});
  list.provoking = Provoking::Last;
  CHECK(trianglesOf(list) == Triangles{{4, 5, 6}, {6, 5, 7}, {6, 7, 8}});
}

TEST_CASE("trianglesOf makes fans around their first vertex, which does not provoke", "[assembly]") {
  DrawList list = listOf({4, 5, 6, 7}, Topology::Fan);
  CHECK(trianglesOf(list) == Triangles{{5, 6, 4}, {6, 7, 4}});
  list.provoking = Provoking::Last;
  CHECK(trianglesOf(list) == Triangles{{4, 5, 6}, {4, 6, 7}});
}

TEST_CASE("trianglesOf restarts at the largest index of the type, and drops what is cut off", "[assembly]") {
  for (const int bits : {16, 32}) {
    const std::uint32_t cut = bits == 16 ? 0xffff : 0xffffffff;
    const auto cutAs = [&](std::vector<std::uint32_t> indices, Topology topology) {
      DrawList list = listOf(indices, topology);
      list.indexBits = bits;
      list.draws[0].restarts = true;
      list.draws[0].baseVertex = 1;
      return trianglesOf(list);
    };
    CHECK(cutAs({0, 1, cut, 2, 3, 4, 5, cut, cut, 6, 7, 8}, Topology::Strip) ==
          Triangles{{3, 4, 5}, {4, 6, 5}, {7, 8, 9}});
    CHECK(cutAs({0, 1, 2, cut, 3, 4, 5, 6}, Topology::Fan) == Triangles{{2, 3, 1}, {5, 6, 4}, {6, 7, 4}});
    CHECK(cutAs({0, 1, 2, 3, cut, 4, 5, 6}, Topology::Triangles) == Triangles{{1, 2, 3}, {5, 6, 7}});
  }
}

TEST_CASE("assembled gives each instance a draw and vertices of its own", "[assembly]") {
  DrawList list = listOf({0, 1, 2, 3}, Topology::Strip);
  list.draws[0].offset = 7;
  list.draws[0].instances = 2;
  list.draws[0].firstInstance = 1;
  list.instances = {{}, {{2, 1, 1, 1}, {0, 5, 0, 0}, 100}, {{-1, 1, 1, 1}, {0, 0, 0.5F, 0}, 200}};
  const DrawList plain = assembled(list);
  CHECK(isAssembled(plain));
  REQUIRE(plain.draws.size() == 2);
  CHECK(plain.draws[0].offset == 107);
  CHECK(plain.draws[1].offset == 207);
  REQUIRE(plain.indices.size() == 12);
  const std::array<float, 6> columns{0, 1, 2, 1, 3, 2};
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK(plain.positions[plain.indices[k]] == glm::vec3(2 * columns[k], 5, 1));
    CHECK(plain.positions[plain.indices[6 + k]] == glm::vec3(-columns[k], 0, 1.5F));
  }
}

TEST_CASE("assembled changes no list of triangles", "[assembly]") {
  const DrawList list = listOf({0, 1, 2, 4, 3, 2}, Topology::Triangles);
  const DrawList same = assembled(list);
  CHECK(isAssembled(list));
  CHECK(same.indices == list.indices);
  CHECK(same.positions == list.positions);
  CHECK(same.draws.size() == 1);
}

TEST_CASE("assembled refuses what is out of range", "[assembly]") {
  const auto isRefused = [](const auto& change) {
    DrawList list = listOf({0, 1, 2, 9}, Topology::Strip);
    list.instances.resize(2);
    CHECK_NOTHROW(validate(list));
    change(list);
    CHECK_THROWS_AS(validate(list), InputError);
  };
  isRefused([](DrawList& l) { l.draws[0].baseVertex = 1; });
  isRefused([](DrawList& l) { l.draws[0].baseVertex = 0xfffffffe; });
  isRefused([](DrawList& l) { l.indices[3] = 0xffffffff; });
  isRefused([](DrawList& l) { l.draws[0].count = 5; });
  isRefused([](DrawList& l) { l.draws[0].topology = Topology::Triangles; });
  isRefused([](DrawList& l) { l.draws[0].instances = 3; });
  isRefused([](DrawList& l) { l.draws[0].firstInstance = 3; });
  isRefused([](DrawList& l) { l.indexBits = 8; });
  isRefused([](DrawList& l) { l.indexBits = 16, l.indices[0] = 0x10000; });
  isRefused([](DrawList& l) { l.value = PixelValue::VertexValues; });
  isRefused([](DrawList& l) { l.clipDepth = ClipDepth::ZeroToOne; });
  isRefused([](DrawList& l) { l.value = PixelValue::Pairs, l.draws[0].back = 3; });
  isRefused([](DrawList& l) { l.value = PixelValue::Pairs, l.format = {{8, 8, 8}}; });
  isRefused([](DrawList& l) { l.draws[0].offset = 1, l.draws[0].instances = 1, l.instances[0].id = 0xffffffff; });
}

TEST_CASE("PairNumbers counts the pairs of draws in the order of offsets, and names no other pair", "[assembly]") {
  DrawList list = listOf({0, 1, 2, 3, 4}, Topology::Strip);
  list.value = PixelValue::Pairs;
  list.draws[0].offset = 0x80000000;
  list.draws.push_back({.count = 4, .offset = 5, .back = {}});
  list.draws[1].topology = Topology::Strip;
  const PairNumbers pairs(list);
  const std::uint64_t low = std::uint64_t{5} << 32, high = std::uint64_t{0x80000000} << 32;
  const std::array<std::uint64_t, 5> all{low, low + 1, high, high + 1, high + 2};
  for (ItemId number = 0; number < 5; ++number) {
    CHECK(pairs.numberOf(all[number]) == number);
    CHECK(pairs.pairOf(number) == all[number]);
  }
  CHECK(pairs.numberOf(UINT64_MAX) == 0xffffffff);
  CHECK(pairs.pairOf(0xffffffff) == UINT64_MAX);
  for (const std::uint64_t other : {low + 2, high + 3, std::uint64_t{0}, UINT64_MAX - 1})
    CHECK(pairs.numberOf(other) == 0xfffffffe);
  const DrawList plain = assembled(list);
  CHECK(plain.value == PixelValue::TriangleNumbers);
  CHECK(plain.draws[0].offset == 2);
  CHECK(plain.draws[1].offset == 0);
}
