/// What the compiler must not touch: every number that is drawn is a binary32 number, however it was made.
#include <catch2/catch.hpp>
#include <glm/glm.hpp>

namespace {

/// Out of line, so that nothing is known about the numbers when it is compiled.
[[gnu::noinline]] glm::dvec2 throughFloat(const glm::dvec2& value) { return glm::dvec2(glm::vec2(value)); }

[[gnu::noinline]] double productAndSum(double a, double b, double c) { return a * b + c; }

}  // namespace

TEST_CASE("narrowing to binary32 and widening again loses the digits it should", "[rounding]") {
  CHECK(throughFloat({0.1, 1e30}) == glm::dvec2(0.1f, 1e30f));
  CHECK(throughFloat({1.0 / 3, 16777217}) == glm::dvec2(1.0f / 3.0f, 16777216));
}

TEST_CASE("products are rounded before they are summed", "[rounding]") {
  // (1 + 2^-27)^2 = 1 + 2^-26 + 2^-54 rounds to 1 + 2^-26, so nothing is left; a fused multiply-add leaves 2^-54.
  const double a = 1 + 0x1p-27;
  CHECK(productAndSum(a, a, -(1 + 0x1p-26)) == 0);
}
