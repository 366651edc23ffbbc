// A reduced vector still fails, and nothing more can go. Devices with known faults draw every smaller vector again.
#include "reference/conformance/verdict/reduction.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/verdict/error_pixel.h"
#include "tests/support/injected_faults.h"

using namespace hemitex;
using reference::TestVector;

namespace {

constexpr std::size_t manyRuns = 20000;

TestVector named(const std::string& name) {
  for (const auto& vectors : {reference::vectorSuite(), reference::sceneVectors(HEMITEX_DATA)})
    for (const TestVector& vector : vectors)
      if (vector.name == name) return vector;
  throw std::logic_error("the suite has no vector " + name);
}

std::size_t texelsOf(const TestVector& vector) {
  std::size_t texels = 0;
  for (const raster::IndexMap& map : vector.list.indexMaps) texels += map.ids.size();
  return texels;
}

int pixelsOf(const TestVector& vector) {
  int pixels = 0;
  for (const reference::VectorFace& face : vector.faces) pixels += face.face.scissor.width * face.face.scissor.height;
  return pixels;
}

}  // namespace

TEST_CASE("fewestTriangles leaves those that are needed together", "[verdict]") {
  std::vector<reference::DrawnTriangle> all;
  for (std::uint32_t t = 0; t < 1000; ++t) all.push_back({0, t});
  const std::vector<std::uint32_t> needed{3, 4, 500, 999};
  int runs = 0;
  const auto kept = reference::fewestTriangles(all, [&](std::span<const reference::DrawnTriangle> triangles) {
    ++runs;
    return std::all_of(needed.begin(), needed.end(), [&](std::uint32_t each) {
      return std::any_of(triangles.begin(), triangles.end(), [=](const auto& t) { return t.triangle == each; });
    });
  });
  std::vector<std::uint32_t> numbers;
  for (const auto& triangle : kept) numbers.push_back(triangle.triangle);
  CHECK(numbers == needed);
  CHECK(runs < 200);
}

// The pretended fault needs one face, a pixel column, two texel columns and three vertices: the rest must go.
TEST_CASE("reduce leaves exactly what the fault needs", "[verdict]") {
  const TestVector vector = named("five-faces");
  const raster::Scissor& whole = vector.faces[2].face.scissor;
  const int column = whole.column + whole.width / 3;
  const auto fails = [&](const TestVector& smaller) {
    const auto shows = [&](const reference::VectorFace& face) {
      const raster::Scissor& scissor = face.face.scissor;
      return face.name == vector.faces[2].name && scissor.column <= column && column < scissor.column + scissor.width;
    };
    const bool hasMap = std::any_of(smaller.list.indexMaps.begin(), smaller.list.indexMaps.end(),
                                    [](const raster::IndexMap& map) { return map.width >= 2; });
    return hasMap && !smaller.list.indices.empty() && std::any_of(smaller.faces.begin(), smaller.faces.end(), shows);
  };
  REQUIRE(fails(vector));
  const TestVector reduced = reference::reduce(vector, fails, manyRuns);
  REQUIRE(reduced.faces.size() == 1);
  CHECK(reduced.faces[0].name == vector.faces[2].name);
  CHECK(reduced.faces[0].face.scissor.column == column);
  CHECK(pixelsOf(reduced) == 1);
  CHECK(texelsOf(reduced) == 2);
  CHECK(reduced.list.indices.size() == 3);
  CHECK(reduced.list.positions.size() == 3);
  CHECK_NOTHROW(raster::validate(reduced.list));
}

TEST_CASE("reduce calls the device at most as often as it may", "[verdict]") {
  std::size_t runs = 0;
  const auto fails = [&](const TestVector&) { return ++runs % 2 == 1; };
  // Thousands of vertices: without calls, the passes must not go on.
  reference::reduce(named("centre-fans-later-nearer"), fails, 7);
  CHECK(runs == 7);
}

// The device with the fault draws each smaller vector. Triangles: most faults show on one, a wrong order on two, and the
// map of another draw on those of two draws.
TEST_CASE("reduce leaves one triangle of half of the known faults, and at most four of each", "[verdict]") {
  std::vector<std::size_t> triangles;
  for (const tests::Injection& injection : tests::injectedFaults()) {
    INFO(injection.fault << " on " << injection.vector);
    const TestVector vector = named(injection.vector);
    const auto fails = [&](const TestVector& smaller) {
      if (smaller.list.indices.empty()) return false;
      const tests::Buffers found = injection.draw(smaller, {});
      for (std::size_t f = 0; f < found.size(); ++f) {
        const raster::Scissor& scissor = smaller.faces[f].face.scissor;
        if (found[f].ids.size() != static_cast<std::size_t>(scissor.width * scissor.height)) return false;
      }
      return hasErrors(judge(smaller, found, injection.profile));
    };
    REQUIRE(fails(vector));
    const TestVector reduced = reference::reduce(vector, fails, manyRuns);
    CHECK(fails(reduced));
    triangles.push_back(reduced.list.indices.size() / 3);
    UNSCOPED_INFO(injection.fault << ": " << triangles.back() << " triangles, " << pixelsOf(reduced) << " pixels, "
                                  << texelsOf(reduced) << " texels, " << reduced.list.positions.size() << " vertices");
  }
  std::sort(triangles.begin(), triangles.end());
  CHECK(triangles[triangles.size() / 2] == 1);
  CHECK(triangles.back() <= 4);
  CHECK(triangles.size() > 20);
}
