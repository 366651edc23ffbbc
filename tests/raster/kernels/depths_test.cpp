// The depth kernels give the same results with each instruction set, bit for bit.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <tuple>

#include "raster/kernels/kernels.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

namespace {

struct Drawn {
  raster::DepthBuffer buffer;
  std::vector<bool> taken;
  raster::UnresolvedPixels unresolved;
};

/// Each triangle twice, so that the second is unresolved wherever it is in front. Triangle t has the numbers 2 t and 2
/// t
/// + 1.
Drawn draw(const raster::Kernels& kernels, const std::vector<raster::ScreenTriangle>& triangles,
           const raster::Face& face) {
  Drawn drawn;
  drawn.buffer.clear(face.scissor);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t time = 0; time < 2; ++time)
      drawn.taken.push_back(kernels.testDepths(triangles[t], 2 * t + time, drawn.buffer, drawn.unresolved));
  return drawn;
}

/// Calls check(kernels, length, i, endOfRun, end) for each pixel i of runs of 1, 2, 3, ... pixels, and for ends of the
/// row in the last 60 pixels of `size`.
template <typename Check>
void forEachRunAndEnd(int size, const Check& check) {
  for (const raster::Kernels& kernels : raster::allKernels()) {
    INFO(kernels.instructionSet);
    for (int end = size - 60; end <= size; ++end)
      for (int first = 0, length = 1; first < end; first += length, ++length) {
        const int endOfRun = std::min(first + length, end);
        for (int i = first; i < endOfRun; ++i) check(kernels, length, i, endOfRun, end);
      }
  }
}

}  // namespace

TEST_CASE("Kernels::testDepths gives the same bits with each instruction set", "[kernels]") {
  raster::DrawList list = crossingTriangles();
  // Wide triangles in front of all, with a shared side along a row of samples, which belongs to one of them.
  const auto near = [](float x, float y) { return glm::vec3(x, y, 1) / 64.0F; };
  for (const float y : {-0.9F, 0.9F})
    addTriangle(list, {near(-0.9F, 1.0F / 128), near(0.9F, 1.0F / 128), near(0.1F, y)}, {{0, 0}, {1, 0}, {0, 1}});
  for (const raster::Face& face : facesAndParts()) {
    const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face);
    const Drawn plain = draw(raster::allKernels().back(), triangles, face);
    CHECK(!plain.unresolved.pixels.empty());
    for (const raster::Kernels& kernels : raster::allKernels()) {
      INFO(kernels.instructionSet << ", " << face.scissor.width << " columns");
      const Drawn drawn = draw(kernels, triangles, face);
      CHECK(drawn.buffer.inverseDepth == plain.buffer.inverseDepth);
      CHECK(drawn.buffer.triangle == plain.buffer.triangle);
      CHECK(drawn.taken == plain.taken);
      CHECK(sorted(drawn.unresolved) == sorted(plain.unresolved));
    }
  }
}

TEST_CASE("Kernels::testDepths lists a second triangle of the same plane as unresolved where it covers samples",
          "[kernels]") {
  const raster::Face face = frontFace(64);
  raster::DrawList list = plainList();
  addDraw(list, 0);
  addTriangle(list, {{-3, -3, 1}, {3, -3, 1}, {0, 3, 1}});
  addTriangle(list, {{-0.5F, -0.6F, 1}, {0.7F, -0.1F, 1}, {0.1F, 0.6F, 1}});
  const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face);
  REQUIRE(triangles.size() == 2);
  for (const raster::Kernels& kernels : raster::allKernels()) {
    INFO(kernels.instructionSet);
    // Alone, the second is drawn where it covers samples.
    raster::DepthBuffer alone, both;
    raster::UnresolvedPixels unresolved;
    alone.clear(face.scissor);
    kernels.testDepths(triangles[1], 1, alone, unresolved);
    const auto covered = static_cast<std::size_t>(std::count(alone.triangle.begin(), alone.triangle.end(), 1U));
    CHECK(unresolved.pixels.empty());
    both.clear(face.scissor);
    for (std::uint32_t t = 0; t < 2; ++t) kernels.testDepths(triangles[t], t, both, unresolved);
    CHECK(covered > 100);
    REQUIRE(unresolved.pixels.size() == covered);
    for (const auto& [column, row] : unresolved.pixels) CHECK(alone.triangle[alone.pixelAt(column, row)] == 1);
  }
}

TEST_CASE("Kernels::endOfRun stops at another triangle, with each instruction set", "[kernels]") {
  // Runs of 1, 2, 3, ... pixels; values behind `end` repeat the last one.
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t length = 1; length < 40; ++length) triangles.insert(triangles.end(), length, length % 2);
  const auto size = static_cast<int>(triangles.size());
  triangles.insert(triangles.end(), raster::maxLanes, triangles.back());
  forEachRunAndEnd(size, [&](const raster::Kernels& kernels, int, int i, int endOfRun, int end) {
    REQUIRE(kernels.endOfRun(triangles.data(), i, end) == endOfRun);
  });
}

TEST_CASE("Kernels::endOfSmall stops at a pixel without a small triangle, with each instruction set", "[kernels]") {
  // Runs of 1, 2, 3, ... pixels, in turn of small triangles and of others.
  const std::array<std::uint32_t, 3> others{0, raster::firstSmall - 1, raster::noTriangle};
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t length = 1; length < 40; ++length)
    for (std::uint32_t i = 0; i < length; ++i)
      triangles.push_back(length % 2 == 0 ? others[length / 2 % 3]
                                          : raster::noTriangle - (i % 2 == 0 ? 1 : raster::firstSmall - 1));
  const auto size = static_cast<int>(triangles.size());
  triangles.insert(triangles.end(), raster::maxLanes, raster::firstSmall);
  forEachRunAndEnd(size, [&](const raster::Kernels& kernels, int length, int i, int endOfRun, int end) {
    REQUIRE(kernels.endOfSmall(triangles.data(), i, end) == (length % 2 == 0 ? i : endOfRun));
  });
}

TEST_CASE("Kernels::isHidden holds where all pixels of a part are nearer, with each instruction set", "[kernels]") {
  raster::DepthBuffer buffer;
  buffer.clear({3, 6, 50, 20});
  std::fill(buffer.inverseDepth.begin(), buffer.inverseDepth.end(), 3.0);
  for (const raster::Kernels& kernels : raster::allKernels()) {
    INFO(kernels.instructionSet);
    for (int width = 1; width < 20; ++width) {
      const raster::Scissor part{5, 7, width, 3};
      CHECK(kernels.isHidden(buffer, part, 2.9));
      CHECK(!kernels.isHidden(buffer, part, 3.0));
      for (const auto& [column, row, isInside] : {std::tuple(5, 7, true), std::tuple(4 + width, 9, true),
                                                  std::tuple(5 + width, 9, false), std::tuple(4, 8, false)}) {
        double& depth = buffer.inverseDepth[buffer.pixelAt(column, row)];
        depth = 1;
        CHECK(kernels.isHidden(buffer, part, 2.9) == !isInside);
        depth = 3;
      }
    }
  }
}
