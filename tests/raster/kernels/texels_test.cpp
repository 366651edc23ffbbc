// The texel kernels give the same results with each instruction set, bit for bit, and the exact texels.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>

#include "raster/kernels/interpolation_bounds.h"
#include "raster/kernels/kernels.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

namespace {

bool isCovered(const raster::ScreenTriangle& triangle, int column, int row) {
  return std::all_of(triangle.edges.begin(), triangle.edges.end(),
                     [=](const raster::Edge& edge) { return edge.at(column, row) >= (edge.inclusive ? 0 : 1); });
}

/// The triangle numbers that a face shows.
raster::DepthBuffer drawn(const std::vector<raster::ScreenTriangle>& triangles, const raster::Face& face) {
  raster::DepthBuffer buffer;
  raster::UnresolvedPixels unresolved;
  buffer.clear(face.scissor);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    raster::allKernels().back().testDepths(triangles[t], t, buffer, unresolved);
  return buffer;
}

/// The results of a kernel for a run.
struct Texels {
  std::vector<std::uint32_t> texels;
  std::vector<std::pair<int, int>> unresolved;
};

Texels texelsOf(const raster::Kernels& kernels, const raster::PixelRun& run, const raster::TexelPlanes& planes) {
  // Behind the run, the mark that kernels use for an open texel.
  Texels found{std::vector<std::uint32_t>(static_cast<std::size_t>(run.count + raster::maxLanes), 0xffffffff), {}};
  raster::UnresolvedPixels unresolved;
  kernels.findTexels(run, planes, 7, found.texels.data(), unresolved);
  found.texels.resize(static_cast<std::size_t>(run.count));
  found.unresolved = sorted(unresolved);
  for (const auto& [row, column] : found.unresolved)
    if (column >= run.firstColumn && column < run.firstColumn + run.count)
      found.texels[static_cast<std::size_t>(column - run.firstColumn)] = 0;
  return found;
}

/// Compares the texels of each run of a face with each instruction set; returns the longest run.
int compareTexels(const raster::DrawList& list, const raster::Face& face,
                  const std::vector<std::pair<int, int>>& maps) {
  const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face);
  const raster::DepthBuffer buffer = drawn(triangles, face);
  const int columns = face.scissor.width;
  int longest = 0;
  for (const auto& [width, height] : maps)
    for (int row = 0; row < face.scissor.height; ++row)
      for (int first = 0, end = 0; first < columns; first = end) {
        const std::size_t begin = buffer.rowAt(row);
        const std::uint32_t number = buffer.triangle[begin + static_cast<std::size_t>(first)];
        while (end < columns && buffer.triangle[begin + static_cast<std::size_t>(end)] == number) ++end;
        if (number == raster::noTriangle) continue;
        longest = std::max(longest, end - first);
        const raster::PixelRun run{&triangles[number], row, first, end - first,
                                   buffer.inverseDepth.data() + begin + first};
        const raster::TexelPlanes planes(triangles[number], width, height);
        const Texels plain = texelsOf(raster::allKernels().back(), run, planes);
        for (const raster::Kernels& kernels : raster::allKernels()) {
          INFO(kernels.instructionSet << ", row " << row << ", columns " << first << " to " << end);
          const Texels found = texelsOf(kernels, run, planes);
          REQUIRE(found.unresolved == plain.unresolved);
          REQUIRE(found.texels == plain.texels);
        }
      }
  return longest;
}

}  // namespace

TEST_CASE("Kernels::findTexels gives the same texels with each instruction set, for runs of all lengths", "[kernels]") {
  compareTexels(crossingTriangles(), frontFace(64), {{16, 16}, {1, 5}, {1024, 1}, {65536, 32768}});
}

TEST_CASE("Kernels::findTexels gives the same texels with each instruction set, along steep and flat walls",
          "[kernels]") {
  // Each wall fills the view. Its depth grows from left to right, and its coordinates leave the map on both sides.
  raster::Face face = frontFace(256);
  face.scissor.height = 24;
  for (const float depth : {1.0F, 1.5F, 4.0F, 20.0F, 300.0F})
    for (const float reach : {0.01F, 0.9F, 7.0F, 1e3F, 1e6F, 1e9F}) {
      raster::DrawList list = plainList();
      addDraw(list, 0);
      addTriangle(list, {{-1.1F, -1.2F, 1}, {1.1F * depth, -1.3F * depth, depth}, {0, 5, 1.2F}},
                  {{0.05F, 0.03F}, {reach, 0.4F}, {0.3F, -reach}});
      const int longest = compareTexels(list, face, {{16, 16}, {1, 7}, {1024, 1000}, {5, 65536}});
      CHECK(longest > 200);
    }
}

TEST_CASE("Kernels::findTexels finds a single texel everywhere, however large the coordinates", "[kernels]") {
  raster::DrawList list = plainList();
  addDraw(list, 0);
  addTriangle(list, {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}}, {{-1e18F, 0}, {1e18F, 1e18F}, {7, -1e18F}});
  const raster::Face face = frontFace(64);
  const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face);
  const raster::DepthBuffer buffer = drawn(triangles, face);
  const raster::PixelRun run{triangles.data(), 3, 0, 64, buffer.inverseDepth.data() + buffer.rowAt(3)};
  for (const raster::Kernels& kernels : raster::allKernels()) {
    INFO(kernels.instructionSet);
    const Texels found = texelsOf(kernels, run, raster::TexelPlanes(triangles.front(), 1, 1));
    CHECK(found.unresolved.empty());
    CHECK(found.texels == std::vector<std::uint32_t>(64, 7));
  }
}

TEST_CASE("Kernels::findTexels beside a border gives the exact texel or an unresolved one, with each instruction set",
          "[kernels]") {
  // Walls as above. Coordinates are shifted so that a pixel of a run lies 2^-6 to 2^-25 texels from a border. That is
  // from well above to close to the rounding error. The pixel is often the first or the last, where 1/w differs most
  // from the middle.
  raster::Face face = frontFace(256);
  face.scissor.height = 4;
  std::mt19937 random(4);
  const auto below = [&random](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  int decided = 0, open = 0;
  for (const float depth : {1.0F, 1.5F, 3.1F, 30.0F, 300.0F})
    for (const int size : {5, 16, 1024, 65536})
      for (const float reach : {1e-3F, 0.9F, 7.0F, 40.0F}) {
        raster::DrawList list = plainList();
        addDraw(list, 0);
        addTriangle(list, {{-1.1F, -1.2F, 1}, {1.1F * depth, -1.3F * depth, depth}, {0, 5, 1.2F}},
                    {{0.05F, 0.03F}, {0.05F + reach, 0.4F}, {0.3F, -reach}});
        const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face);
        const raster::DepthBuffer buffer = drawn(triangles, face);
        for (int times = 0; times < 60; ++times) {
          const int row = below(4), first = below(100), count = times % 2 == 0 ? 256 - first : 20 + below(156 - 20);
          const std::size_t begin = buffer.pixelAt(first, row);
          REQUIRE(buffer.triangle[begin] == 0);
          REQUIRE(raster::allKernels().back().endOfRun(buffer.triangle.data() + begin, 0, count) == count);
          const int at = times % 3 == 0 ? 0 : times % 3 == 1 ? count - 1 : below(count);
          raster::ScreenTriangle triangle = triangles.front();
          const raster::EdgeValues edge = raster::edgeValues(triangle, first + at, row);
          double position = 0;
          for (std::size_t k = 0; k < 3; ++k) position += edge[k] * triangle.inverseDepth[k] * triangle.u[k];
          position = position / raster::inverseDepthAt(triangle, edge) * size;
          const double off = std::ldexp(random() % 2 == 0 ? 1 : -1, -6 - below(20));
          for (double& u : triangle.u) u += (std::round(position) + off - position) / size;
          const raster::PixelRun run{&triangle, row, first, count, buffer.inverseDepth.data() + begin};
          const raster::TexelPlanes planes(triangle, size, 8);
          const auto exact =
              static_cast<std::uint32_t>(7 + raster::texelExactly(triangle, triangle.v, 8, first + at, row) * size +
                                         raster::texelExactly(triangle, triangle.u, size, first + at, row));
          for (const raster::Kernels& kernels : raster::allKernels()) {
            const Texels found = texelsOf(kernels, run, planes);
            const bool isOpen =
                std::binary_search(found.unresolved.begin(), found.unresolved.end(), std::pair(row, first + at));
            ++(isOpen ? open : decided);
            INFO(kernels.instructionSet << ", depth " << depth << ", size " << size << ", reach " << reach << ", off "
                                        << off);
            if (!isOpen) REQUIRE(found.texels[static_cast<std::size_t>(at)] == exact);
          }
        }
      }
  CHECK(decided > 10 * open);
  CHECK(open > 0);
}

TEST_CASE("Kernels::findExactTexels gives the texels of texelExactly, with each instruction set", "[kernels]") {
  const raster::Face face = frontFace(64);
  raster::DrawList list = plainList();
  addDraw(list, 0);
  // Corners at half pixels and texels that begin at samples; seen straight on, and with different short depths.
  for (const float depth : {1.0F, 2.5F}) {
    const auto point = [&](float column, float row, float w) {
      return glm::vec3((column / 32 - 1) * w, (row / 32 - 1) * w, w);
    };
    addTriangle(list, {point(0.5F, 0.5F, 1), point(48.5F, 3.5F, depth), point(7.5F, 60.5F, depth)},
                {{-0.25F, 0}, {1, 0.5F}, {0.5F, 1.25F}});
  }
  int runs = 0;
  for (const raster::ScreenTriangle& triangle : screenTriangles(list, face))
    for (const int size : {1, 16, 48})
      for (int row = triangle.firstRow; row < triangle.endRow; ++row) {
        const auto u = exactQuotient(triangle, triangle.u, size), v = exactQuotient(triangle, triangle.v, 2 * size);
        REQUIRE((u && v));
        std::vector<std::uint32_t> expected;
        int first = triangle.firstColumn;
        for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
          if (!isCovered(triangle, column, row)) continue;
          if (expected.empty()) first = column;
          expected.push_back(
              static_cast<std::uint32_t>(7 + texelExactly(triangle, triangle.v, 2 * size, column, row) * size +
                                         texelExactly(triangle, triangle.u, size, column, row)));
        }
        const raster::PixelRun run{&triangle, row, first, static_cast<int>(expected.size()), nullptr};
        for (const raster::Kernels& kernels : raster::allKernels()) {
          std::vector<std::uint32_t> found(expected.size() + raster::maxLanes);
          kernels.findExactTexels(run, {*u, *v}, size, 2 * size, 7, found.data());
          found.resize(expected.size());
          INFO(kernels.instructionSet << ", row " << row << ", size " << size);
          REQUIRE(found == expected);
        }
        ++runs;
      }
  CHECK(runs > 300);
}
