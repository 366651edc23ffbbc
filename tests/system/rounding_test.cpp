/// The compiler must keep the rounding of numbers to binary32.
#include <catch2/catch.hpp>
#include <glm/glm.hpp>
#include <vector>

namespace {

/// Not inline, so that the compiler cannot use the values.
[[gnu::noinline]] glm::dvec2 throughFloat(const glm::dvec2& value) { return glm::dvec2(glm::vec2(value)); }
[[gnu::noinline]] glm::dvec3 throughFloat(const glm::dvec3& value) { return glm::dvec3(glm::vec3(value)); }
[[gnu::noinline]] glm::dvec4 throughFloat(const glm::dvec4& value) { return glm::dvec4(glm::vec4(value)); }

[[gnu::noinline]] void throughFloats(const std::vector<double>& values, std::vector<double>& result) {
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = static_cast<double>(static_cast<float>(values[i]));
}

[[gnu::noinline]] void throughFloats(const std::vector<glm::dvec2>& values, std::vector<glm::dvec2>& result) {
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = glm::dvec2(glm::vec2(values[i]));
}

[[gnu::noinline]] void throughFloats(const std::vector<glm::dvec3>& values, std::vector<glm::dvec3>& result) {
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = glm::dvec3(glm::vec3(values[i]));
}

[[gnu::noinline]] double productAndSum(double a, double b, double c) { return a * b + c; }

}  // namespace

TEST_CASE("throughFloat rounds to binary32", "[rounding]") {
  CHECK(throughFloat(glm::dvec2(0.1, 1e30)) == glm::dvec2(0.1f, 1e30f));
  CHECK(throughFloat(glm::dvec2(1.0 / 3, 16777217)) == glm::dvec2(1.0f / 3.0f, 16777216));
  CHECK(throughFloat(glm::dvec3(0.1, 0.2, 0.3)) == glm::dvec3(0.1f, 0.2f, 0.3f));
  CHECK(throughFloat(glm::dvec4(0.1, 0.2, 0.3, 0.7)) == glm::dvec4(0.1f, 0.2f, 0.3f, 0.7f));
}

TEST_CASE("glm::vec2 conversions in vectorized loops round like single conversions", "[rounding]") {
  std::vector<double> numbers(37, 0.1), results(37);
  throughFloats(numbers, results);
  CHECK(results == std::vector<double>(37, 0.1f));
  std::vector<glm::dvec2> pairs(37, glm::dvec2(0.1, 0.3)), pairResults(37);
  throughFloats(pairs, pairResults);
  CHECK(pairResults == std::vector<glm::dvec2>(37, glm::dvec2(0.1f, 0.3f)));
  std::vector<glm::dvec3> triples(37, glm::dvec3(0.1, 0.2, 0.3)), tripleResults(37);
  throughFloats(triples, tripleResults);
  CHECK(tripleResults == std::vector<glm::dvec3>(37, glm::dvec3(0.1f, 0.2f, 0.3f)));
}

TEST_CASE("products are rounded before they are summed, without fused multiply-add", "[rounding]") {
  // (1 + 2^-27)^2 = 1 + 2^-26 + 2^-54 rounds to 1 + 2^-26, so that nothing is left; a fused multiply-add leaves 2^-54.
  const double a = 1 + 0x1p-27;
  CHECK(productAndSum(a, a, -(1 + 0x1p-26)) == 0);
}
