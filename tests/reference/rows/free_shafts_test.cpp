/// FreeShafts: proofs that nothing lies between two facets.
#include "reference/rows/free_shafts.h"

#include <catch2/catch.hpp>

#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::reference;

namespace {

FreeShafts shaftsOf(const std::vector<Surface>& surfaces) {
  return FreeShafts(convexPolygons(tests::sceneOf(surfaces)));
}

/// A unit square at this height, over (x, 0), that faces up or down.
Surface square(double x, double z, bool isUp) {
  const glm::dvec3 corner(x, 0, z), along(1, 0, 0), across(0, 1, 0);
  return isUp ? tests::parallelogram("", corner, along, across) : tests::parallelogram("", corner, across, along);
}

}  // namespace

TEST_CASE("FreeShafts are free in a convex room, and over a street", "[free_shafts]") {
  std::vector<Surface> street;
  for (int i = 0; i < 8; ++i) {
    street.push_back(square(i, 0, true));
    street.push_back(tests::parallelogram("", {i, 1, 0}, {1, 0, 0}, {0, 0, 1}));  // faces to y = 0
    street.push_back(tests::parallelogram("", {i, 0, 0}, {0, 0, 1}, {1, 0, 0}));  // faces to y = 1
  }
  const FreeShafts shafts = shaftsOf(street);
  for (std::uint32_t a = 0; a < street.size(); ++a)
    for (std::uint32_t b = 0; b < street.size(); ++b) CHECK(shafts.isFree(a, b));
}

TEST_CASE("FreeShafts are not free where something is between, or covers an end", "[free_shafts]") {
  const Surface floor = square(0, 0, true), roof = square(0, 1, false);
  const auto isFree = [&](const Surface& other) { return shaftsOf({floor, roof, other}).isFree(0, 1); };
  CHECK(isFree(square(3, 0.5, true)));
  CHECK(isFree(square(1, 0.5, true)));     // touches the shaft
  CHECK(isFree(square(0.5, 1.25, true)));  // behind the roof
  CHECK(isFree(square(1, 0, true)));       // beside the floor
  CHECK_FALSE(isFree(square(0.99, 0.5, true)));
  CHECK_FALSE(isFree(square(0.5, 0.5, false)));
  CHECK_FALSE(isFree(square(0.5, 0, true)));  // the later of two faces in one place covers
  CHECK_FALSE(isFree(square(0.5, 1, false)));
  CHECK_FALSE(isFree(tests::parallelogram("", {0.5, -1, 0.5}, {0, 3, 0}, {0, 0, 1e-3})));
}

TEST_CASE("FreeShafts between oblique facets are free beside the line of sight", "[free_shafts]") {
  // The box of both facets is large, and the other one is in it, but not between.
  const Surface from = square(0, 0, true), to = square(9, 9, false);
  CHECK(shaftsOf({from, to, square(8, 0.5, true)}).isFree(0, 1));
  CHECK(shaftsOf({from, to, square(0, 8.5, true)}).isFree(0, 1));
  CHECK_FALSE(shaftsOf({from, to, square(4.5, 4.5, true)}).isFree(0, 1));
}

TEST_CASE("FreeShafts tell which backs may be seen", "[free_shafts]") {
  const FreeShafts shafts =
      shaftsOf({square(0, 0, true), square(2, 1, false), square(2, 1, true), square(2, 0, false)});
  CHECK_FALSE(shafts.maySeeBack(0, 0));
  CHECK_FALSE(shafts.maySeeBack(0, 1));
  CHECK(shafts.maySeeBack(0, 2));
  CHECK_FALSE(shafts.maySeeBack(0, 3));  // in the plane
}
