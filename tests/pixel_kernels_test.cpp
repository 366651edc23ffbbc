// The kernels of every instruction set compute what the plain ones do, bit for bit.
#include "raster/pixel_kernels.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <tuple>

#include "raster/cluster.h"
#include "raster/software_renderer.h"
#include "tests/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

namespace {

std::vector<raster::ScreenTriangle> screenTriangles(const raster::DrawList& list, const raster::Face& face) {
  std::vector<raster::ScreenTriangle> triangles;
  for (const raster::Cluster& cluster : raster::clustersOf(list))
    raster::appendScreenTriangles(list, face, cluster.runs, {}, triangles);
  return triangles;
}

/// In order of rows and columns: the order in which kernels list pixels is theirs.
std::vector<std::pair<int, int>> sorted(const raster::UndecidedPixels& undecided) {
  std::vector<std::pair<int, int>> pixels;
  for (const raster::Pixel& pixel : undecided.pixels) pixels.emplace_back(pixel.row, pixel.column);
  std::sort(pixels.begin(), pixels.end());
  return pixels;
}

struct Drawn {
  raster::DepthBuffer buffer;
  std::vector<bool> taken;
  raster::UndecidedPixels undecided;
};

/// Each triangle twice, so that its second time is undecided wherever it is in front; triangle t has the numbers 2 t
/// and 2 t + 1.
Drawn draw(const raster::PixelKernels& kernels, const std::vector<raster::ScreenTriangle>& triangles,
           const raster::Face& face) {
  Drawn drawn;
  drawn.buffer.clear(face.scissor);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t time = 0; time < 2; ++time)
      drawn.taken.push_back(kernels.offer(triangles[t], 2 * t + time, drawn.buffer, drawn.undecided));
  return drawn;
}

bool isCovered(const raster::ScreenTriangle& triangle, int column, int row) {
  return std::all_of(triangle.edges.begin(), triangle.edges.end(),
                     [=](const raster::Edge& edge) { return edge.at(column, row) >= (edge.inclusive ? 0 : 1); });
}

/// A face with a narrow part of its columns, so that rows end at every place of a vector.
std::vector<raster::Face> facesAndParts() {
  std::vector<raster::Face> faces;
  for (const raster::Face& face : threeFaces()) faces.push_back(face);
  for (int width = 1; width < 20; ++width) {
    faces.push_back(frontFace(64));
    faces.back().scissor = {21, 5, width, 40};
  }
  return faces;
}

/// Holds the texels of each run that a face shows against those of the plain kernels; returns the longest run.
int compareTexels(const raster::DrawList& list, const raster::Face& face,
                  const std::vector<std::pair<int, int>>& maps) {
  const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face);
  const Drawn drawn = draw(raster::plainKernels(), triangles, face);
  const int columns = face.scissor.width;
  int longest = 0;
  for (const auto& [width, height] : maps)
    for (int row = 0; row < face.scissor.height; ++row)
      for (int first = 0, end = 0; first < columns; first = end) {
        const std::size_t begin = drawn.buffer.rowAt(row);
        const std::uint32_t number = drawn.buffer.triangle[begin + static_cast<std::size_t>(first)];
        while (end < columns && drawn.buffer.triangle[begin + static_cast<std::size_t>(end)] == number) ++end;
        if (number == raster::noTriangle) continue;
        longest = std::max(longest, end - first);
        const raster::PixelRun run{&triangles[number / 2], row, first, end - first,
                                   drawn.buffer.inverseDepth.data() + begin + first};
        const raster::TexelPlanes planes(triangles[number / 2], width, height);
        const auto texels = [&](const raster::PixelKernels& kernels) {
          std::vector<std::uint32_t> found(static_cast<std::size_t>(run.count + raster::mostLanes));
          raster::UndecidedPixels undecided;
          kernels.findTexels(run, planes, 7, found.data(), undecided);
          for (const raster::Pixel& pixel : undecided.pixels)
            found[static_cast<std::size_t>(pixel.column - run.firstColumn)] = 0xffffffff;
          found.resize(static_cast<std::size_t>(run.count));
          return found;
        };
        const std::vector<std::uint32_t> plain = texels(raster::plainKernels());
        for (const raster::PixelKernels& kernels : raster::simdKernels()) {
          INFO(kernels.name << ", row " << row << ", columns " << first << " to " << end);
          REQUIRE(texels(kernels) == plain);
        }
      }
  return longest;
}

}  // namespace

TEST_CASE("the depth test is the same bits with every instruction set", "[kernels]") {
  const raster::DrawList list = crossingTriangles();
  for (const raster::Face& face : facesAndParts()) {
    const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face);
    const Drawn plain = draw(raster::plainKernels(), triangles, face);
    CHECK(!plain.undecided.pixels.empty());
    for (const raster::PixelKernels& kernels : raster::simdKernels()) {
      INFO(kernels.name << ", " << face.scissor.width << " columns");
      const Drawn drawn = draw(kernels, triangles, face);
      CHECK(drawn.buffer.inverseDepth == plain.buffer.inverseDepth);
      CHECK(drawn.buffer.triangle == plain.buffer.triangle);
      CHECK(drawn.taken == plain.taken);
      CHECK(sorted(drawn.undecided) == sorted(plain.undecided));
    }
  }
}

TEST_CASE("a part of the depth buffer hides what is behind all of its pixels, with every instruction set",
          "[kernels]") {
  const raster::Face face = frontFace(64);
  raster::DepthBuffer buffer;
  buffer.clear(face.scissor);
  std::fill(buffer.inverseDepth.begin(), buffer.inverseDepth.end(), 3.0);
  std::vector<raster::PixelKernels> all = raster::simdKernels();
  all.push_back(raster::plainKernels());
  for (const raster::PixelKernels& kernels : all) {
    INFO(kernels.name);
    for (int width = 1; width < 20; ++width) {
      const raster::Scissor part{5, 7, width, 3};
      CHECK(kernels.isHidden(buffer, part, 2.9));
      CHECK(!kernels.isHidden(buffer, part, 3.0));
      for (const auto& [column, row, isInside] : {std::tuple(5, 7, true), std::tuple(4 + width, 9, true),
                                                  std::tuple(5 + width, 9, false), std::tuple(4, 8, false)}) {
        double& depth = buffer.inverseDepth[buffer.rowAt(row) + static_cast<std::size_t>(column)];
        depth = 1;
        CHECK(kernels.isHidden(buffer, part, 2.9) == !isInside);
        depth = 3;
      }
    }
  }
}

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
  std::vector<raster::PixelKernels> all = raster::simdKernels();
  all.push_back(raster::plainKernels());
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
        for (const raster::PixelKernels& kernels : all) {
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

TEST_CASE("item buffers are the same with every instruction set", "[kernels]") {
  const raster::DrawList list = crossingTriangles();
  const std::vector<raster::Face> faces = facesAndParts();
  const auto words = [&](const raster::PixelKernels& kernels) {
    std::vector<raster::Word> all;
    for (const raster::ItemBuffer& buffer : raster::SoftwareRenderer(list, kernels).render(faces, {}))
      all.insert(all.end(), buffer.words.begin(), buffer.words.end());
    return all;
  };
  const std::vector<raster::Word> plain = words(raster::plainKernels());
  for (const raster::PixelKernels& kernels : raster::simdKernels()) {
    INFO(kernels.name);
    CHECK(words(kernels) == plain);
  }
}
