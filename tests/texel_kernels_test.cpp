// The texel kernels of every instruction set compute what the plain ones do, bit for bit.
#include "raster/texel_kernels.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "raster/depth_kernels.h"
#include "tests/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

namespace {

bool isCovered(const raster::ScreenTriangle& triangle, int column, int row) {
  return std::all_of(triangle.edges.begin(), triangle.edges.end(),
                     [=](const raster::Edge& edge) { return edge.at(column, row) >= (edge.inclusive ? 0 : 1); });
}

/// What a face shows of triangles, by their numbers.
raster::DepthBuffer drawn(const std::vector<raster::ScreenTriangle>& triangles, const raster::Face& face) {
  raster::DepthBuffer buffer;
  raster::UndecidedPixels undecided;
  buffer.clear(face.scissor);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    raster::plainDepthKernels().offer(triangles[t], t, buffer, undecided);
  return buffer;
}

/// Holds the texels of each run that a face shows against those of the plain kernels; returns the longest run.
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
        const auto texels = [&](const raster::TexelKernels& kernels) {
          std::vector<std::uint32_t> found(static_cast<std::size_t>(run.count + raster::mostLanes));
          raster::UndecidedPixels undecided;
          kernels.findTexels(run, planes, 7, found.data(), undecided);
          for (const raster::Pixel& pixel : undecided.pixels)
            found[static_cast<std::size_t>(pixel.column - run.firstColumn)] = 0xffffffff;
          found.resize(static_cast<std::size_t>(run.count));
          return found;
        };
        const std::vector<std::uint32_t> plain = texels(raster::plainTexelKernels());
        for (const raster::TexelKernels& kernels : raster::simdTexelKernels()) {
          INFO(kernels.name << ", row " << row << ", columns " << first << " to " << end);
          REQUIRE(texels(kernels) == plain);
        }
      }
  return longest;
}

}  // namespace

TEST_CASE("texels are the same with every instruction set, for runs of every length", "[kernels]") {
  compareTexels(crossingTriangles(), frontFace(64), {{16, 16}, {1, 5}, {1024, 1}, {65536, 32768}});
}

TEST_CASE("texels are the same with every instruction set, along walls steep and flat", "[kernels]") {
  // Each wall fills the view; its depth grows from left to right, its coordinates leave the map on both sides.
  raster::Face face = frontFace(256);
  face.scissor.height = 24;
  for (const float depth : {1.0F, 1.5F, 4.0F, 300.0F})
    for (const float reach : {0.9F, 7.0F, 1e6F}) {
      raster::DrawList list = plainList();
      addDraw(list, 0);
      addTriangle(list, {{-1.1F, -1.2F, 1}, {1.1F * depth, -1.3F * depth, depth}, {0, 5, 1.2F}},
                  {{0.05F, 0.03F}, {reach, 0.4F}, {0.3F, -reach}});
      const int longest = compareTexels(list, face, {{16, 16}, {1, 7}, {1024, 1000}});
      CHECK(longest > 200);
    }
}

TEST_CASE("exact quotients give the texels of the exact fallback, with every instruction set", "[kernels]") {
  const raster::Face face = frontFace(64);
  raster::DrawList list = plainList();
  addDraw(list, 0);
  // Corners at halves of pixels, texels that begin at samples, straight on and across depths of few bits.
  for (const float depth : {1.0F, 2.5F}) {
    const auto point = [&](float column, float row, float w) {
      return glm::vec3((column / 32 - 1) * w, (row / 32 - 1) * w, w);
    };
    addTriangle(list, {point(0.5F, 0.5F, 1), point(48.5F, 3.5F, depth), point(7.5F, 60.5F, depth)},
                {{-0.25F, 0}, {1, 0.5F}, {0.5F, 1.25F}});
  }
  std::vector<raster::TexelKernels> all = raster::simdTexelKernels();
  all.push_back(raster::plainTexelKernels());
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
        for (const raster::TexelKernels& kernels : all) {
          std::vector<std::uint32_t> found(expected.size() + raster::mostLanes);
          kernels.findExactTexels(run, {*u, *v}, size, 2 * size, 7, found.data());
          found.resize(expected.size());
          INFO(kernels.name << ", row " << row << ", size " << size);
          REQUIRE(found == expected);
        }
        ++runs;
      }
  CHECK(runs > 300);
}
