// PlainRenderer, the rules to read, against the fast renderer and the rational evaluator on test vectors.
#include "raster/plain/plain_renderer.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>

#include "raster/base/parallel.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/trace/rational_rasterizer.h"
#include "reference/conformance/vectors/random_vectors.h"

using namespace hemitex;
using reference::TestVector;

namespace {

std::vector<raster::ItemBuffer> drawnPlainly(const TestVector& vector) {
  return raster::render(raster::PlainRenderer(vector.list), reference::facesOf(vector));
}

bool areEqual(const std::vector<raster::ItemBuffer>& a, const std::vector<raster::ItemBuffer>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const raster::ItemBuffer& one, const raster::ItemBuffer& other) { return one.ids == other.ids; });
}

/// How many of `count` vectors PlainRenderer draws differently from the renderer or from evaluateRules.
template <typename MakeVector>
std::size_t differingVectors(std::size_t count, const MakeVector& make) {
  std::atomic<std::size_t> differing = 0;
  raster::parallelFor(count, [&](std::size_t k) {
    const TestVector vector = make(k);
    const std::vector<raster::ItemBuffer> plain = drawnPlainly(vector);
    std::vector<raster::ItemBuffer> rational;
    for (const raster::Face& face : reference::facesOf(vector))
      rational.push_back(reference::evaluateRules(sourceOf(vector), face));
    if (!areEqual(plain, reference::render(vector)) || !areEqual(plain, rational)) ++differing;
  });
  return differing;
}

std::size_t differingVectors(std::size_t count) {
  return differingVectors(count, [](std::size_t k) { return reference::interleavedRandomVector(11, k); });
}

/// The same of a family of version 2.
std::size_t differingVectors(std::size_t count, const reference::RandomFamily& family) {
  return differingVectors(count, [&](std::size_t k) { return reference::randomVector(k, family.name); });
}

}  // namespace

TEST_CASE("PlainRenderer equals the renderer on each vector of vectorSuite", "[plain]") {
  for (const TestVector& vector : reference::vectorSuite()) {
    INFO(vector.name);
    CHECK(areEqual(drawnPlainly(vector), reference::render(vector)));
  }
}

TEST_CASE("PlainRenderer equals evaluateRules on each vector of drawVectors", "[plain]") {
  const std::vector<TestVector> vectors = reference::drawVectors();
  CHECK(differingVectors(vectors.size(), [&](std::size_t k) { return vectors[k]; }) == 0);
}

TEST_CASE("PlainRenderer equals the renderer and evaluateRules on vectors of interleavedRandomVector", "[plain]") {
  CHECK(differingVectors(2000) == 0);
}

TEST_CASE("PlainRenderer equals the renderer and evaluateRules on vectors of newRandomFamilies", "[plain]") {
  for (const reference::RandomFamily& family : reference::newRandomFamilies()) {
    INFO(family.name);
    CHECK(differingVectors(1000, family) == 0);
  }
}

// The target million_vectors runs them; the tests above are a part of them.
TEST_CASE("PlainRenderer equals evaluateRules on a million triangles in clip space", "[.million_vectors]") {
  constexpr std::size_t perVector = 4;
  CHECK(reference::randomVector(0, "clip-space").list.indices.size() == 3 * perVector);
  CHECK(differingVectors(1000000 / perVector, [](std::size_t k) { return reference::randomVector(k, "clip-space"); }) ==
        0);
}

TEST_CASE("PlainRenderer equals the renderer and evaluateRules on 100,000 vectors", "[.million_vectors]") {
  CHECK(differingVectors(100000) == 0);
  for (const reference::RandomFamily& family : reference::newRandomFamilies())
    CHECK(differingVectors(100000, family) == 0);
}
