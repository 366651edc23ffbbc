// Measured memory and parts of a solution.
#include "reference/measurement/bench/solution_profile.h"

#include <malloc.h>

#include <catch2/catch.hpp>
#include <cstddef>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/solver/shooting_state.h"
#include "raster/interface/item_id.h"
#include "tests/support/box_scene.h"

using namespace hemitex;

namespace {

/// Whether the allocator reports the heap size; that of the address sanitizer does not.
bool heapIsTold() {
  const std::vector<std::byte> some(1000);
  return mallinfo2().uordblks > 0;
}

}  // namespace

TEST_CASE("solutionMemory includes the data of an element and of a pixel", "[bench]") {
  if (!heapIsTold()) {
    WARN("skipped: the allocator does not report the heap size");
    return;
  }
  const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const reference::SolutionMemory memory = reference::solutionMemory(scene, 128, 128);
  // The element, its number in its patch and in its texel, and its radiosity.
  const auto element = static_cast<double>(sizeof(radiosity::Element) + 4 + 4 + sizeof(glm::dvec3));
  CHECK(memory.bytesPerElement > element);
  CHECK(memory.bytesPerElement < 2 * element);
  CHECK(memory.bytesPerPixel > sizeof(raster::ItemId));
  CHECK(memory.bytesPerPixel < 100);
  CHECK(static_cast<double>(memory.peakBytes) > 6 * 128 * 128 * element);
}

TEST_CASE("solutionParts measures the given number of shots", "[bench]") {
  const radiosity::Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const reference::SolutionParts parts = reference::solutionParts(scene, 8, 16, 5, 1);
  CHECK(parts.elements == 6 * 8 * 8);
  CHECK(parts.shots == 5);
  CHECK(parts.hemicubes > 0);
  CHECK(parts.beside() > 0);
  CHECK(parts.total() == Approx(parts.hemicubes + parts.beside()));
  CHECK(parts.besideOfTotal == Approx(parts.beside() / parts.total()));
}
