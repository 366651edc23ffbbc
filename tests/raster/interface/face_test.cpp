// validate of a face, at both sides of each limit.
#include "raster/interface/face.h"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "raster/base/input_error.h"
#include "tests/support/validity.h"

using namespace hemitex::raster;

namespace {

/// A valid face whose scissor rectangle touches no border of the viewport.
Face face() { return {{1, 2, 3}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, 0.5f, 8, {2, 3, 4, 2}}; }

bool isValid(const std::function<void(Face&)>& change) { return hemitex::tests::isValidAfter(change, face()); }

}  // namespace

TEST_CASE("determinant is the triple product of the rows", "[face]") {
  CHECK(determinant(face()) == 6);
  CHECK(determinant({{}, {1, 2, 3}, {4, 5, 6}, {7, 8, 10}, 1, 2, {}}) == -3);
}

TEST_CASE("validate accepts even resolutions from 2 to 4096", "[face]") {
  for (const int resolution : {2, 4, 4094, 4096})
    CHECK(isValid([&](Face& f) { f.resolution = resolution, f.scissor = {0, 0, resolution, resolution}; }));
  for (const int resolution : {-2, 0, 1, 3, 4095, 4097, 4098})
    CHECK_FALSE(isValid([&](Face& f) { f.resolution = resolution, f.scissor = {0, 0, resolution, resolution}; }));
}

TEST_CASE("validate accepts scissor rectangles with pixels that lie in the viewport", "[face]") {
  for (const Scissor& inside : {Scissor{0, 0, 8, 8}, Scissor{0, 7, 8, 1}, Scissor{7, 0, 1, 8}, Scissor{3, 2, 5, 6}})
    CHECK(isValid([&](Face& f) { f.scissor = inside; }));
  for (const Scissor& wrong : {Scissor{-1, 0, 2, 8}, Scissor{0, -1, 8, 2}, Scissor{0, 0, 0, 8}, Scissor{0, 0, 8, 0},
                               Scissor{4, 3, 5, 5}, Scissor{3, 4, 5, 5}, Scissor{0, 0, -1, 8}, Scissor{0, 0, 8, -1}})
    CHECK_FALSE(isValid([&](Face& f) { f.scissor = wrong; }));
  CHECK(isValid([](Face& f) { f.scissor = {.width = 8, .height = 8}; }));
  CHECK_FALSE(isValid([](Face& f) { f.scissor = {}; }));
}

TEST_CASE("validate accepts viewports of 1 to 16384 columns and rows, which hold the scissor rectangle", "[face]") {
  const auto isViewport = [](int columns, int rows, const Scissor& scissor) {
    return isValid([&](Face& f) { f.viewport = Viewport{columns, rows}, f.scissor = scissor; });
  };
  CHECK(isViewport(1, 1, {0, 0, 1, 1}));
  CHECK(isViewport(16384, 8, {16000, 0, 384, 8}));
  CHECK(isViewport(7, 16384, {6, 16383, 1, 1}));
  CHECK_FALSE(isViewport(0, 8, {0, 0, 1, 1}));
  CHECK_FALSE(isViewport(8, -1, {0, 0, 1, 1}));
  CHECK_FALSE(isViewport(16385, 8, {0, 0, 1, 1}));
  CHECK_FALSE(isViewport(8, 7, {0, 0, 8, 8}));
  CHECK_FALSE(isViewport(7, 8, {0, 0, 8, 8}));
  // Its resolution does not matter then.
  CHECK(isValid([](Face& f) { f.viewport = Viewport{3, 3}, f.resolution = 0, f.scissor = {0, 0, 3, 3}; }));
}

TEST_CASE("requireUsual refuses viewports of their own and samples at corners", "[face]") {
  CHECK_NOTHROW(requireUsual(face()));
  Face own = face(), corner = face();
  own.viewport = Viewport{8, 8};
  corner.sample = SamplePlace::Corner;
  for (const Face& other : {own, corner}) {
    CHECK_FALSE(isUsual(other));
    CHECK_THROWS_AS(requireUsual(other), InputError);
  }
}

TEST_CASE("validate rejects near distances that are not positive and finite", "[face]") {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  CHECK(isValid([](Face& f) { f.nearDistance = std::numeric_limits<float>::denorm_min(); }));
  for (const float wrong : {0.0f, -1.0f, infinity, std::numeric_limits<float>::quiet_NaN()})
    CHECK_FALSE(isValid([&](Face& f) { f.nearDistance = wrong; }));
}

TEST_CASE("validate accepts a face that is made without values", "[face]") { CHECK_NOTHROW(validate(Face())); }

TEST_CASE("validate rejects vectors that are not finite, and rows in a plane", "[face]") {
  for (const float wrong : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (int k = 0; k < 3; ++k)
      for (glm::vec3 Face::*vector : {&Face::eye, &Face::x, &Face::y, &Face::w})
        CHECK_FALSE(isValid([&](Face& f) { (f.*vector)[k] = wrong; }));
  CHECK_FALSE(isValid([](Face& f) { f.w = f.x + f.y; }));
  CHECK(isValid([](Face& f) { f.w = -f.w; }));
}
