#include "reference/matrices/matrix_judge.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "raster/base/short_number.h"
#include "reference/matrices/judged_rows.h"
#include "reference/matrices/matrix_fault.h"

namespace hemitex::reference {
namespace {

using raster::shortNumber;

/// Of sums and of closed forms.
constexpr double rounding = 1e-6;
/// Sums of entries average the errors of single ones: this part of the tolerance is left to them.
constexpr double toleranceOfSums = 0.25;
/// Backs are met from buried parts of facets above all, which programs divide in other ways: they may differ more.
constexpr double toleranceOfBacks = 4;

/// Counts one kind of problem, and describes the worst case.
struct Worst {
  std::size_t count = 0;
  double excess = 0;
  std::string text = {};

  /// Calls describe() for the worst case so far.
  template <typename Describe>
  void add(double value, const Describe& describe) {
    ++count;
    if (value <= excess) return;
    excess = value;
    text = describe();
  }
};

/// Whether a value is within its errors and a part of the tolerance.
bool isNear(double found, double truth, double error, double tolerance) {
  return std::abs(found - truth) <= confidence * error + tolerance * std::max(found, truth) + smallestFactor;
}

class Judge {
 public:
  Judge(const JudgedMatrix& matrix, const JudgeSettings& settings) : matrix_(matrix), settings_(settings) {}

  MatrixVerdict verdict() {
    checkEntries();
    checkReciprocity();
    rows_ = judgedRows(matrix_, settings_);
    checkRows();
    checkSums();
    bool isOutsideWrong = false;
    if (matrix_.hasOutside()) {
      checkWholeRows();
      isOutsideWrong = hasWrongOutside();
    }
    if (!matrix_.matrix.error.empty()) checkErrors();
    if (!verdict_.problems.empty()) verdict_.fault = matrixFault(matrix_, rows_, settings_, isOutsideWrong);
    return verdict_;
  }

 private:
  void add(const std::string& problem) { verdict_.problems.push_back(problem); }
  void add(const Worst& worst, const std::string& what) {
    if (worst.count > 0) add(std::to_string(worst.count) + what + "; the worst is " + worst.text);
  }
  std::span<const JudgedRow> onlyRows() const { return std::span(rows_.all).first(rows_.rows); }
  std::string name(const JudgedRow& row) const { return nameOfFacet(matrix_.facet(row.surface)); }

  void checkEntries() {
    Worst outside;
    std::size_t selves = 0;
    std::uint32_t largest = 0;
    for (std::uint32_t r = 0; r < matrix_.facets(); ++r) {
      const SparseRow row = matrix_.matrix.row(r);
      double sum = 0;
      for (std::size_t k = 0; k < row.column.size() && row.column[k] < matrix_.facets(); ++k) {
        const double value = row.value[k], excess = std::max(-value, value - 1);
        sum += value;
        if (row.column[k] == r && value > smallestFactor) ++selves;
        if (excess > rounding)
          outside.add(excess, [&] {
            return shortNumber(value) + " from " + nameOfFacet(r) + " to " + nameOfFacet(row.column[k]);
          });
      }
      if (sum <= verdict_.largestRowSum) continue;
      verdict_.largestRowSum = sum;
      largest = r;
    }
    add(outside, " entries are outside [0, 1]");
    if (verdict_.largestRowSum > 1 + 1e-3)
      add("the row of " + nameOfFacet(largest) + " sums to " + shortNumber(verdict_.largestRowSum) + ", above 1");
    // A facet may see its images.
    if (selves > 0 && matrix_.mesh.scene.instances.size() == 1)
      add(std::to_string(selves) + " planar facets see themselves");
  }

  void checkReciprocity() {
    double difference = 0, sum = 0, expected = 0;
    Worst worst;
    const SparseMatrix& matrix = matrix_.matrix;
    std::vector<double> area(matrix_.facets(), 0.0);  // of the facets
    for (std::uint32_t s = 0; s < matrix_.area.size(); ++s) area[matrix_.facet(s)] = matrix_.area[s];
    for (const auto& [repetition, original] : matrix_.mesh.repeated) area[repetition] = area[original];
    for (std::uint32_t i = 0; i < matrix_.facets(); ++i) {
      const SparseRow row = matrix.row(i);
      for (std::size_t k = 0; k < row.column.size() && row.column[k] < matrix_.facets(); ++k) {
        const std::uint32_t j = row.column[k];
        const double there = area[i] * row.value[k], back = area[j] * matrix_.entry(j, i);
        sum += there;
        if (!matrix.error.empty() && area[j] > 0)
          expected += (area[i] * row.error[k] + area[j] * matrix_.statedError(j, i, there / area[j])) / 2;
        // A pair of which one entry is missing is met once.
        difference += (back == 0 ? 2 : 1) * std::abs(there - back) / 2;
        worst.add(std::abs(there - back), [&] { return nameOfFacet(i) + " and " + nameOfFacet(j); });
      }
    }
    verdict_.reciprocity = sum > 0 ? difference / sum : 0;
    if (difference - unclear * expected > std::max(0.2, 4 * settings_.tolerance) * sum)
      add("reciprocity is missed by " + shortNumber(100 * verdict_.reciprocity) +
          " % of all exchange; the worst pair is " + worst.text);
  }

  /// Where the given rows leave their intervals.
  void checkRows() {
    Worst impossible, above, outside, missing;
    double difference = 0, sum = 0, noise = 0, ofErrors = 0;
    for (const JudgedRow& row : rows_.all)
      for (std::uint32_t to = 0; to < row.to.size(); ++to) {
        const JudgedEntry& entry = row.to[to];
        const double found = entry.found, truth = entry.truth, closed = entry.closed, apart = std::abs(found - truth);
        const double allowed = confidence * entry.error + settings_.tolerance * std::max(found, truth) + entry.smallest;
        const double beyond =
            found - closed * (1 + std::max(settings_.tolerance, 2e-3)) - (closed > 0 ? confidence * entry.stated : 0);
        if (entry.isTied && beyond <= entry.smallest) continue;
        if (!row.isColumn) {
          const double area = matrix_.area[row.surface];
          difference += area * apart;
          noise += area * entry.measured;
          ofErrors += area * entry.error;
          sum += area * truth;
        }
        const auto count = [&](Worst& kind, double excess, const std::string& where) {
          kind.add(excess, [&] {
            const std::string own = name(row), other = nameOfFacet(matrix_.facet(to));
            return shortNumber(found) + " from " + (row.isColumn ? other : own) + " to " +
                   (row.isColumn ? own + ", in parts of what the latter sends" : other) + ", where " + where;
          });
        };
        if (closed == 0 && found > entry.smallest)
          count(impossible, found, "nothing can be seen");
        else if (beyond > entry.smallest)
          count(above, found - closed, "the closed form without blockers is " + shortNumber(closed));
        else if (found == 0 && truth > allowed)
          count(missing, truth, "rays measure " + shortNumber(truth));
        else if (apart > allowed)
          count(outside, apart,
                "rays measure " + shortNumber(truth) + " +- " + shortNumber(confidence * entry.measured));
      }
    verdict_.measuredRows = rows_.rows;
    verdict_.difference = sum > 0 ? difference / sum : difference;
    verdict_.noise = sum > 0 ? noise / sum : 0;
    if (difference - unclear * ofErrors > settings_.tolerance * sum && verdict_.difference > rounding)
      add("the measured rows differ from rays by " + shortNumber(100 * verdict_.difference) + " % of their light");
    const std::string entries = " entries of " + std::to_string(rows_.rows) + " measured rows ";
    add(impossible, entries + "are above 0 where nothing can be seen");
    add(above, entries + "are above the closed form without blockers");
    add(missing, entries + "are 0 where something is seen");
    add(outside, entries + "differ from rays");
  }

  /// Sums of rows and of columns, of each and of all together.
  void checkSums() {
    Worst wrong;
    double found = 0, truth = 0, squares = 0;
    for (const JudgedRow& row : rows_.all) {
      const RowSums& sums = row.sums;
      if (!row.isColumn) {
        const double area = matrix_.area[row.surface];
        found += area * sums.found;
        truth += area * sums.truth;
        squares += area * area * (row.sumError * row.sumError + sums.stated * sums.stated);
      }
      if (isNear(sums.found, sums.truth, std::hypot(row.sumError, sums.stated), toleranceOfSums * settings_.tolerance))
        continue;
      wrong.add(std::abs(sums.found - sums.truth), [&] {
        return (row.isColumn ? "the light that " + name(row) + " receives" : "the row of " + name(row)) + ": " +
               shortNumber(sums.found) + ", where rays measure " + shortNumber(sums.truth) + " +- " +
               shortNumber(confidence * row.sumError);
      });
    }
    add(wrong, " sums of rows or columns differ from rays");
    if (wrong.count == 0 &&
        std::abs(found - truth) > confidence * std::sqrt(squares) + toleranceOfSums * settings_.tolerance * truth)
      add("all entries of the measured rows together are " + shortNumber(found / truth) + " of what rays measure");
  }

  /// Rows with surroundings and backs.
  void checkWholeRows() {
    Worst open;
    for (std::uint32_t f = 0; f < matrix_.facets(); ++f) {
      const SparseRow row = matrix_.matrix.row(f);
      const double sum = std::accumulate(row.value.begin(), row.value.end(), 0.0);
      if (sum != 0 && std::abs(sum - 1) > toleranceOfSums * settings_.tolerance)
        open.add(std::abs(sum - 1), [&] { return "that of " + nameOfFacet(f) + ": " + shortNumber(sum); });
    }
    add(open, " rows with surroundings and backs do not sum to 1");
  }

  /// Checks the surroundings and backs of the measured rows.
  bool hasWrongOutside() {
    const std::size_t before = verdict_.problems.size();
    for (std::uint32_t which = 0; which < 2; ++which) {
      Worst wrong;
      for (const JudgedRow& row : onlyRows()) {
        if (which == 1 && matrix_.touches[row.surface]) continue;
        const Measurement& truth = row.outside[which];
        const std::uint32_t facet = matrix_.facet(row.surface), column = matrix_.facets() + which;
        const double found = matrix_.entry(facet, column);
        const double error = std::hypot(truth.standardError, matrix_.statedError(facet, column, truth.value));
        if (!isNear(found, truth.value, error, (which == 0 ? 1 : toleranceOfBacks) * settings_.tolerance))
          wrong.add(std::abs(found - truth.value), [&] {
            return shortNumber(found) + " from " + name(row) + ", where rays measure " + shortNumber(truth.value);
          });
      }
      add(wrong, (which == 0 ? " shares of the surroundings of " : " shares of backs of ") +
                     std::to_string(rows_.rows) + " measured rows differ from rays");
    }
    return verdict_.problems.size() > before;
  }

  /// Whether the errors that the matrix states explain its differences from rays.
  void checkErrors() {
    double difference = 0, expected = 0, all = 0;
    for (const JudgedRow& row : onlyRows())
      for (const JudgedEntry& entry : row.to) {
        if (entry.isTied) continue;
        const double area = matrix_.area[row.surface];
        difference += area * std::abs(entry.found - entry.truth);
        expected += area * (entry.stated + entry.measured);
        all += area * entry.truth;
      }
    if (difference > 4 * expected + 0.01 * all)
      add("entries of the measured rows are off by " + shortNumber(difference / expected) +
          " times the errors that the matrix states");
  }

  const JudgedMatrix& matrix_;
  JudgeSettings settings_;
  JudgedRows rows_;
  MatrixVerdict verdict_;
};

}  // namespace

MatrixVerdict judgeMatrix(const SparseMatrix& matrix, const FacetMesh& mesh, const JudgeSettings& settings) {
  const std::size_t facets = mesh.facets;
  if (matrix.rows() == facets && (matrix.columns == facets || matrix.columns == facets + 2))
    return Judge(JudgedMatrix(matrix, mesh), settings).verdict();
  return {
      .problems = {"the matrix has " + std::to_string(matrix.rows()) + " rows and " + std::to_string(matrix.columns) +
                   " columns, and the mesh has " + std::to_string(facets) + " facets"},
      .fault = matrix.rows() < facets ? "rows are missing: the file is cut off, or belongs to another mesh"
                                      : "the matrix belongs to another mesh"};
}

}  // namespace hemitex::reference
