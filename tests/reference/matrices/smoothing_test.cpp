// MatrixSmoother: reciprocity, sums kept, minimal changes, and smaller errors.
#include "reference/matrices/smoothing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "reference/truth/solution/form_factor_matrix.h"

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

FormFactorMatrix smoothed(const FormFactorMatrix& matrix, const std::vector<double>& area) {
  MatrixSmoother smoother(area);
  SparseMatrix sparse{.columns = matrix.size};
  for (std::size_t i = 0; i < matrix.size; ++i) {
    std::vector<std::uint32_t> columns(matrix.size);
    std::iota(columns.begin(), columns.end(), 0U);
    const auto begin = matrix.factors.begin() + static_cast<std::ptrdiff_t>(i * matrix.size);
    sparse.append({columns, {begin, begin + static_cast<std::ptrdiff_t>(matrix.size)}});
    smoother.add(sparse.row(i));
  }
  smoother.smooth();
  FormFactorMatrix result{matrix.size, std::vector<double>(matrix.factors.size())};
  std::size_t i = 0;
  smoother.forEachRow([&](const SparseRow& row) {
    for (std::size_t k = 0; k < row.column.size(); ++k) result.factors[i * matrix.size + row.column[k]] = row.value[k];
    ++i;
  });
  return result;
}

struct Difference {
  double largest = 0, rootMeanSquare = 0;
};

Difference difference(const FormFactorMatrix& a, const FormFactorMatrix& b) {
  Difference result;
  for (std::size_t i = 0; i < a.factors.size(); ++i) {
    const double moved = std::abs(a.factors[i] - b.factors[i]);
    result.largest = std::max(result.largest, moved);
    result.rootMeanSquare += moved * moved;
  }
  result.rootMeanSquare = std::sqrt(result.rootMeanSquare / static_cast<double>(a.factors.size()));
  return result;
}

}  // namespace

TEST_CASE("MatrixSmoother gives a reciprocal matrix with the same row sums and zeros", "[smoothing]") {
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

TEST_CASE("MatrixSmoother does not change a reciprocal matrix", "[smoothing]") {
  std::mt19937 random(4);
  const Truth right = truth(random);
  CHECK(difference(smoothed(right.matrix, right.area), right.matrix).largest < 1e-14);
}

TEST_CASE("MatrixSmoother gives the matrix with these sums that is nearest to the mean of both directions",
          "[smoothing]") {
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

TEST_CASE("MatrixSmoother reduces random errors", "[smoothing]") {
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

TEST_CASE("MatrixSmoother keeps the row sum of any surface, however small", "[smoothing]") {
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

TEST_CASE("MatrixSmoother gives no value below 0", "[smoothing]") {
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

TEST_CASE("MatrixSmoother gives two surfaces that see only each other the mean of both directions", "[smoothing]") {
  const FormFactorMatrix smooth = smoothed({2, {0, 0.25, 0.15, 0}}, std::vector<double>{1, 2});
  CHECK(smooth.factors[1] == Approx(0.275).epsilon(1e-14));  // (1 * 0.25 + 2 * 0.15) / 2
  CHECK(smooth.factors[2] == Approx(0.1375).epsilon(1e-14));
}

namespace {

/// Rows with errors of a matrix of three facets with the areas 1, 2 and 4, and the columns of surroundings and backs.
/// The exchanges of facets 0 and 1 are exact; the others have the given error of F.
SparseMatrix open(double error) {
  SparseMatrix matrix{.columns = 5};
  matrix.append({{1, 2, 3}, {0.25, 0.5, 0.25}, {0, error, error}});
  matrix.append({{0, 2, 3, 4}, {0.125, 0.5, 0.25, 0.125}, {0, error, error, error}});
  matrix.append({{0, 1, 3}, {0.125, 0.25, 0.625}, {error, error, error}});
  return matrix;
}

SparseMatrix smoothedRows(const SparseMatrix& matrix, const std::vector<double>& area, SmoothingMoves& moves) {
  MatrixSmoother smoother(area);
  for (std::size_t r = 0; r < matrix.rows(); ++r) smoother.add(matrix.row(r));
  moves = smoother.smooth();
  SparseMatrix result{.columns = matrix.columns};
  smoother.forEachRow([&](const SparseRow& row) { result.append(row); });
  return result;
}

double sumOf(const SparseRow& row) { return std::accumulate(row.value.begin(), row.value.end(), 0.0); }

}  // namespace

TEST_CASE("MatrixSmoother moves entries by their errors, also those of surroundings, and keeps exact ones",
          "[smoothing]") {
  const std::vector<double> area{1, 2, 4};
  SmoothingMoves moves;
  const SparseMatrix valid = open(0.01);
  const SparseMatrix same = smoothedRows(valid, area, moves);
  CHECK(same.column == valid.column);
  CHECK(moves.largest < 1e-15);

  SparseMatrix wrong = valid;
  wrong.value[1] += 0.008;  // from 0 to 2, and less to the surroundings
  wrong.value[2] -= 0.008;
  const SparseMatrix smooth = smoothedRows(wrong, area, moves);
  CHECK(moves.missed.empty());
  CHECK(moves.largest < 0.008);
  CHECK(smooth.value[0] == Approx(0.25).margin(1e-6));  // the error of an exact entry is 1e-4 of it: 400 times less
  CHECK(smooth.value[3] == smooth.value[0] / 2);
  for (std::size_t r = 0; r < 3; ++r) CHECK(sumOf(smooth.row(r)) == Approx(1).epsilon(1e-14));
  CHECK(1 * smooth.row(0).value[1] == Approx(4 * smooth.row(2).value[0]).epsilon(1e-14));
  CHECK(2 * smooth.row(1).value[1] == Approx(4 * smooth.row(2).value[1]).epsilon(1e-14));
}

TEST_CASE("MatrixSmoother does not spread a bad row: entries move by no more than their errors", "[smoothing]") {
  const std::vector<double> area{1, 2, 4};
  SparseMatrix wrong = open(0.01);
  wrong.value[1] += 0.1;
  wrong.value[2] -= 0.1;
  SmoothingMoves moves;
  const SparseMatrix smooth = smoothedRows(wrong, area, moves);
  CHECK(std::find(moves.missed.begin(), moves.missed.end(), 0U) != moves.missed.end());
  // The exchange of 0 and 2, on which the rows disagree, has the mean. All others stay near.
  CHECK(smooth.row(0).value[1] == Approx((wrong.row(0).value[1] + 4 * wrong.row(2).value[0]) / 2).margin(0.03));
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t k = 0; k < smooth.row(r).value.size(); ++k) {
      const bool isDisputed = (r == 0 && k == 1) || (r == 2 && k == 0);
      if (!isDisputed) CHECK(std::abs(smooth.row(r).value[k] - wrong.row(r).value[k]) < 0.0101);
    }
}

TEST_CASE("MatrixSmoother gives both facets of a pair an entry, of which one alone saw the other", "[smoothing]") {
  const std::vector<double> area{1, 2, 4};
  SparseMatrix oneWay{.columns = 5};
  const std::vector<double> errors{0.01, 0.01};
  oneWay.append({{1, 3}, {0.5, 0.5}, errors});
  oneWay.append({{0, 3}, {0.25, 0.75}, errors});
  oneWay.append({{1, 3}, {0.01, 0.99}, errors});
  SmoothingMoves moves;
  const SparseMatrix smooth = smoothedRows(oneWay, area, moves);
  REQUIRE(smooth.row(1).column.size() == 3);
  CHECK(smooth.row(1).column[1] == 2);
  CHECK(smooth.row(1).value[1] == Approx(2 * smooth.row(2).value[0]).epsilon(1e-14));
  CHECK(smooth.row(1).value[1] < 0.01);
  for (std::size_t r = 0; r < 3; ++r) CHECK(sumOf(smooth.row(r)) == Approx(1).epsilon(1e-14));
}
