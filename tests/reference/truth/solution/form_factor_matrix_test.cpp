// checkMatrix finds errors added to a valid matrix. smoothed: reciprocity, sums kept, minimal changes, and smaller
// errors.
#include "reference/truth/solution/form_factor_matrix.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

using namespace hemitex::reference;

namespace {

constexpr std::size_t size = 6;

/// A closed, reciprocal matrix: any symmetric exchange is valid if the areas are its row sums. Here it is random with
/// some zeros.
struct Truth {
  FormFactorMatrix matrix{size, std::vector<double>(size* size)};
  std::vector<double> area = std::vector<double>(size);
};

Truth truth(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> exchanged(size * size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      exchanged[i * size + j] = exchanged[j * size + i] = i == j || (i + j) % 5 == 4 ? 0 : 0.1 + uniform(random);
  Truth result;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) result.area[i] += exchanged[i * size + j];
    for (std::size_t j = 0; j < size; ++j)
      result.matrix.factors[i * size + j] = exchanged[i * size + j] / result.area[i];
  }
  return result;
}

/// Errors of 1 % of each value; the rows are closed again, as with rays.
FormFactorMatrix measured(const Truth& right, std::mt19937& random) {
  std::normal_distribution<double> error(0, 0.01);
  FormFactorMatrix matrix = right.matrix;
  for (std::size_t i = 0; i < size; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < size; ++j) sum += matrix.factors[i * size + j] *= 1 + error(random);
    for (std::size_t j = 0; j < size; ++j) matrix.factors[i * size + j] /= sum;
  }
  return matrix;
}

}  // namespace

TEST_CASE("checkMatrix accepts a reciprocal, closed matrix, and measures each error", "[matrix checks]") {
  // Areas 1, 2, 4 and A_i F_ij = A_j F_ji = 0.25, 0.5, 0.75; the diagonal closes the rows.
  const std::vector<double> area{1, 2, 4};
  const FormFactorMatrix matrix{3, {0.25, 0.25, 0.5, 0.125, 0.5, 0.375, 0.125, 0.1875, 0.6875}};
  const MatrixChecks right = checkMatrix(matrix, area);
  CHECK(right.smallestRowSum == 1);
  CHECK(right.largestRowSum == 1);
  CHECK(right.reciprocity == 0);

  FormFactorMatrix wrong = matrix;
  wrong.factors[2 * 3 + 1] += 0.125;  // from 2 to 1: 4 * 0.125 of flux without a counterpart, over the area 2
  const MatrixChecks found = checkMatrix(wrong, area);
  CHECK(found.reciprocity == 0.25);
  CHECK(found.from == 2);
  CHECK(found.to == 1);
  CHECK(found.largestRowSum == 1.125);
  wrong.factors[0] -= 0.125;
  CHECK(checkMatrix(wrong, area).smallestRowSum == 0.875);
}

TEST_CASE("smoothed gives a reciprocal matrix with the same row sums and zeros", "[smoothing]") {
  std::mt19937 random(3);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Truth right = truth(random);
    const FormFactorMatrix raw = measured(right, random), smooth = smoothed(raw, right.area);
    CHECK(checkMatrix(raw, right.area).reciprocity > 1e-3);
    const MatrixChecks checks = checkMatrix(smooth, right.area);
    CHECK(checks.reciprocity < 1e-14);
    CHECK(std::abs(checks.smallestRowSum - 1) < 1e-12);
    CHECK(std::abs(checks.largestRowSum - 1) < 1e-12);
    for (std::size_t i = 0; i < raw.factors.size(); ++i) CHECK((smooth.factors[i] == 0) == (raw.factors[i] == 0));
  }
}

TEST_CASE("smoothed does not change a reciprocal matrix", "[smoothing]") {
  std::mt19937 random(4);
  const Truth right = truth(random);
  CHECK(difference(smoothed(right.matrix, right.area), right.matrix).largest < 1e-14);
}

TEST_CASE("smoothed gives the matrix with these sums that is nearest to the mean of both directions", "[smoothing]") {
  // Adding to S_ab and S_cd what is subtracted from S_bc and S_da keeps all sums. Along such a change the derivative of
  // sum (S - M)^2 / M, twice (S - M) / M with alternating signs, is 0 at the minimum.
  std::mt19937 random(5);
  const Truth right = truth(random);
  const FormFactorMatrix raw = measured(right, random), smooth = smoothed(raw, right.area);
  const auto moved = [&](std::size_t i, std::size_t j) {
    const double mean = (right.area[i] * raw.factors[i * size + j] + right.area[j] * raw.factors[j * size + i]) / 2;
    return right.area[i] * smooth.factors[i * size + j] / mean - 1;
  };
  int checked = 0;
  for (std::size_t a = 0; a < size; ++a)
    for (std::size_t b = 0; b < size; ++b)
      for (std::size_t c = 0; c < size; ++c)
        for (std::size_t d = 0; d < size; ++d) {
          const auto sees = [&](std::size_t i, std::size_t j) { return raw.factors[i * size + j] > 0; };
          if (a == c || b == d || !sees(a, b) || !sees(b, c) || !sees(c, d) || !sees(d, a)) continue;
          ++checked;
          CHECK(std::abs(moved(a, b) - moved(b, c) + moved(c, d) - moved(d, a)) < 1e-12);
        }
  CHECK(checked > 20);
}

TEST_CASE("smoothed reduces random errors", "[smoothing]") {
  std::mt19937 random(6);
  double raw = 0, smooth = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const Truth right = truth(random);
    const FormFactorMatrix matrix = measured(right, random);
    raw += std::pow(difference(matrix, right.matrix).rootMeanSquare, 2);
    smooth += std::pow(difference(smoothed(matrix, right.area), right.matrix).rootMeanSquare, 2);
  }
  // Two measurements of each value have half the variance of one, and the sums are known in addition.
  CHECK(smooth < 0.5 * raw);
}

TEST_CASE("smoothed keeps the row sum of any surface, however small", "[smoothing]") {
  // Six surfaces; one of them shrinks, and its exchange with it.
  for (const double share : {1e-4, 1e-8, 1e-12, 1e-16, 1e-20}) {
    std::mt19937 random(7);
    Truth right = truth(random);
    std::vector<double> exchanged(size * size);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        exchanged[i * size + j] = right.area[i] * right.matrix.factors[i * size + j] * (i == 2 || j == 2 ? share : 1);
    for (std::size_t i = 0; i < size; ++i) {
      right.area[i] = 0;
      for (std::size_t j = 0; j < size; ++j) right.area[i] += exchanged[i * size + j];
      for (std::size_t j = 0; j < size; ++j)
        right.matrix.factors[i * size + j] = exchanged[i * size + j] / right.area[i];
    }
    const MatrixChecks checks = checkMatrix(smoothed(measured(right, random), right.area), right.area);
    INFO(share);
    CHECK(std::abs(checks.smallestRowSum - 1) < 1e-14);
    CHECK(std::abs(checks.largestRowSum - 1) < 1e-14);
  }
}

TEST_CASE("smoothed gives no value below 0", "[smoothing]") {
  // With one number per pair, three sums t determine all: S_12 = (t_1 + t_2 - t_3) / 2, here -0.2. Without that pair
  // the third row needs more than the others have. Their errors are c (s_1, s_2, -s_3), with s the sums of the mean of
  // both directions, and c = (t_1 + t_2 - t_3) / (s_1 + s_2 + s_3) = -0.4 / 1.8.
  const std::vector<double> area{1, 1, 1};
  const FormFactorMatrix smooth = smoothed({3, {0, 0.1, 0.3, 0.1, 0, 0.3, 0.6, 0.6, 0}}, area);
  CHECK(smooth.factors[1] == 0);
  CHECK(smooth.factors[2] == Approx(0.4 + 0.4 / 1.8 * 0.45).epsilon(1e-14));
  CHECK(smooth.factors[5] == Approx(smooth.factors[2]).epsilon(1e-14));

  // 64 rays per row between surfaces of areas 1 to 1000 often have such errors.
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int repeat = 0; repeat < 200; ++repeat) {
    Truth right = truth(random);
    FormFactorMatrix counted = right.matrix;
    for (std::size_t i = 0; i < size; ++i) right.area[i] = std::pow(10, 3 * uniform(random));
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        const double factor = right.matrix.factors[i * size + j] * std::min(1.0, right.area[j] / right.area[i]);
        counted.factors[i * size + j] = std::poisson_distribution<int>(64 * factor)(random) / 64.0;
      }
    const FormFactorMatrix result = smoothed(counted, right.area);
    CHECK(*std::min_element(result.factors.begin(), result.factors.end()) >= 0);
    CHECK(checkMatrix(result, right.area).reciprocity < 1e-14);
  }
}

TEST_CASE("smoothed gives two surfaces that see only each other the mean of both directions", "[smoothing]") {
  const FormFactorMatrix smooth = smoothed({2, {0, 0.25, 0.15, 0}}, std::vector<double>{1, 2});
  CHECK(smooth.factors[1] == Approx(0.275).epsilon(1e-14));  // (1 * 0.25 + 2 * 0.15) / 2
  CHECK(smooth.factors[2] == Approx(0.1375).epsilon(1e-14));
  CHECK(difference({2, {0, 3, 4, 0}}, {2, {0, 0, 0, 0}}).largest == 4);
  CHECK(difference({2, {0, 3, 4, 0}}, {2, {0, 0, 0, 0}}).rootMeanSquare == 2.5);
}
