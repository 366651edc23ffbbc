#include "reference/matrices/smoothing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace hemitex::reference {
namespace {

/// Errors of entries that are called exact are at least this part of their values.
constexpr double smallestError = 1e-4;

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// a + factor b
void addScaled(std::vector<double>& a, double factor, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

/// The x that minimizes |multiply(x) - right| for a symmetric matrix, by conjugate gradients (Bjorck, Numerical Methods
/// for Least Squares Problems, 1996, algorithm 7.4.1: CGLS).
template <typename Multiply>
std::vector<double> leastSquares(const Multiply& multiply, const std::vector<double>& right) {
  const std::size_t size = right.size();
  std::vector<double> x(size, 0.0), rest = right, gradient(size), image(size);
  multiply(rest, gradient);
  std::vector<double> direction = gradient;
  double squared = product(gradient, gradient);
  const double end = 1e-31 * product(right, right);  // what rounding leaves of a gradient
  for (int iteration = 0; iteration < 2000 && squared > end; ++iteration) {
    multiply(direction, image);
    const double step = squared / product(image, image);
    addScaled(x, step, direction);
    addScaled(rest, -step, image);
    multiply(rest, gradient);
    const double before = std::exchange(squared, product(gradient, gradient));
    for (std::size_t i = 0; i < size; ++i) direction[i] = gradient[i] + squared / before * direction[i];
  }
  return x;
}

}  // namespace

MatrixSmoother::MatrixSmoother(std::vector<double> area, double limit) : area_(std::move(area)), limit_(limit) {}

void MatrixSmoother::add(const SparseRow& row) {
  assert(rows_ < area_.size());
  const auto number = static_cast<std::uint32_t>(rows_++);
  hasErrors_ = hasErrors_ || !row.error.empty();
  for (std::size_t k = 0; k < row.column.size(); ++k) {
    const std::uint32_t column = row.column[k];
    const double flux = area_[number] * std::max(row.value[k], 0.0);
    const double error = row.error.empty() ? 0.0 : area_[number] * asStored(row.error[k]);
    if (column >= number) {
      exchanges_.push_back({.low = number, .high = column, .measured = {flux, -1}, .error = {error, error}});
      continue;
    }
    const auto begin = exchanges_.begin() + static_cast<std::ptrdiff_t>(firstOf_[column]),
               end = exchanges_.begin() + static_cast<std::ptrdiff_t>(firstOf_[column + std::size_t{1}]);
    const auto found =
        std::lower_bound(begin, end, number, [](const Exchange& e, std::uint32_t high) { return e.high < high; });
    if (found != end && found->high == number) {
      found->measured[1] = flux;
      found->error[1] = error;
    } else {
      late_.push_back({.low = column, .high = number, .measured = {-1, flux}, .error = {error, error}});
    }
  }
  firstOf_.push_back(exchanges_.size());
}

/// The errors of both measurements. What one row alone sees has the value 0 in the other, with that value as its error.
std::array<double, 2> MatrixSmoother::errorsOf(const Exchange& exchange) const {
  std::array<double, 2> error = exchange.error;
  const double larger = std::max({exchange.measured[0], exchange.measured[1], 0.0});
  for (std::size_t k = 0; k < 2; ++k)
    error[k] = std::max(error[k], exchange.measured[k] < 0 ? larger : smallestError * larger);
  return error;
}

/// Sets the flux and the variance of an exchange.
void MatrixSmoother::settle(Exchange& exchange) const {
  if (exchange.low == exchange.high || !isShared(exchange)) exchange.measured[1] = exchange.measured[0];
  const std::array<double, 2> error = errorsOf(exchange);
  std::array<double, 2> value{};
  for (std::size_t k = 0; k < 2; ++k) value[k] = std::max(exchange.measured[k], 0.0);
  const double both = error[0] + error[1];
  if (both == 0) return;
  exchange.flux = hasErrors_ ? (value[0] * error[1] + value[1] * error[0]) / both : (value[0] + value[1]) / 2;
  exchange.fluxError = 2 * error[0] * error[1] / both;
  exchange.variance = hasErrors_ ? exchange.fluxError * exchange.fluxError : exchange.flux;
}

/// The nearest flux that is not negative, and no farther from a measurement than the limit if errors are known. Where
/// measurements contradict each other, their mean stays.
double MatrixSmoother::limited(const Exchange& exchange, double flux) const {
  if (!hasErrors_) return std::max(flux, 0.0);
  const std::array<double, 2> error = errorsOf(exchange);
  double low = 0, high = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 2; ++k) {
    low = std::max(low, std::max(exchange.measured[k], 0.0) - limit_ * error[k]);
    high = std::min(high, std::max(exchange.measured[k], 0.0) + limit_ * error[k]);
  }
  return low <= high ? std::clamp(flux, low, high) : exchange.flux;
}

/// The sum of a part of the exchanges of each row.
std::vector<double> MatrixSmoother::sums(double Exchange::*part) const {
  std::vector<double> result(area_.size(), 0.0);
  for (const Exchange& exchange : exchanges_) {
    result[exchange.low] += exchange.*part;
    if (exchange.low != exchange.high && isShared(exchange)) result[exchange.high] += exchange.*part;
  }
  return result;
}

/// The change of the sums of rows by multipliers x.
void MatrixSmoother::multiply(const std::vector<double>& x, std::vector<double>& result) const {
  std::fill(result.begin(), result.end(), 0.0);
  for (const Exchange& exchange : exchanges_) {
    const double change = exchange.variance * (x[exchange.low] + (isShared(exchange) ? x[exchange.high] : 0.0));
    result[exchange.low] += change;
    if (exchange.low != exchange.high && isShared(exchange)) result[exchange.high] += change;
  }
}

/// The Lagrange multipliers for errors of the sums of rows. The equations are in units of each row's own variance, so
/// that small values are not lost in the rounding error of large ones.
std::vector<double> MatrixSmoother::multipliers(const std::vector<double>& missing) const {
  std::vector<double> unit = sums(&Exchange::variance), scaled(unit.size());
  for (double& u : unit) u = u > 0 ? 1 / std::sqrt(u) : 0;
  const auto inUnits = [&](std::vector<double> values) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= unit[i];
    return values;
  };
  const auto multiplyInUnits = [&](const std::vector<double>& x, std::vector<double>& result) {
    for (std::size_t i = 0; i < x.size(); ++i) scaled[i] = unit[i] * x[i];
    multiply(scaled, result);
    for (std::size_t i = 0; i < x.size(); ++i) result[i] *= unit[i];
  };
  const std::vector<double> right = inUnits(missing);
  std::vector<double> x = leastSquares(multiplyInUnits, right), rest(right.size());
  // Once more for what rounding left.
  multiplyInUnits(x, rest);
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = right[i] - rest[i];
  addScaled(x, 1, leastSquares(multiplyInUnits, rest));
  return inUnits(std::move(x));
}

SmoothingMoves MatrixSmoother::smooth(bool isClosed) {
  assert(rows_ == area_.size());
  const auto place = [](const Exchange& exchange) { return std::tie(exchange.low, exchange.high); };
  const auto isBefore = [place](const Exchange& a, const Exchange& b) { return place(a) < place(b); };
  std::sort(late_.begin(), late_.end(), isBefore);
  const auto middle = static_cast<std::ptrdiff_t>(exchanges_.size());
  exchanges_.insert(exchanges_.end(), late_.begin(), late_.end());
  late_ = {};
  std::inplace_merge(exchanges_.begin(), exchanges_.begin() + middle, exchanges_.end(), isBefore);

  std::vector<double> wanted(area_.size(), 0.0);
  for (Exchange& exchange : exchanges_) {
    settle(exchange);
    wanted[exchange.low] += std::max(exchange.measured[0], 0.0);
    if (exchange.low != exchange.high && isShared(exchange))
      wanted[exchange.high] += std::max(exchange.measured[1], 0.0);
    if (isClosed && !isShared(exchange)) {
      exchange.flux = std::max(exchange.measured[0], 0.0);
      exchange.variance = 0;
    }
  }
  if (isClosed)
    for (std::size_t row = 0; row < wanted.size(); ++row)
      if (wanted[row] > 0) wanted[row] = area_[row];
  for (bool isOutside = true; isOutside;) {
    std::vector<double> missing = wanted;
    addScaled(missing, -1, sums(&Exchange::flux));
    const std::vector<double> x = multipliers(missing);
    const auto moved = [&](const Exchange& exchange) {
      return exchange.flux + exchange.variance * (x[exchange.low] + (isShared(exchange) ? x[exchange.high] : 0.0));
    };
    isOutside = false;
    for (Exchange& exchange : exchanges_) {
      const double flux = moved(exchange), nearest = limited(exchange, flux);
      if (exchange.variance == 0 || std::abs(flux - nearest) <= 1e-12 * exchange.flux) continue;
      exchange.flux = nearest;
      exchange.variance = 0;
      isOutside = true;
    }
    if (!isOutside)
      for (Exchange& exchange : exchanges_) exchange.flux = moved(exchange);
  }
  return moves(wanted);
}

SmoothingMoves MatrixSmoother::moves(const std::vector<double>& wanted) const {
  SmoothingMoves result;
  double squares = 0;
  std::size_t count = 0;
  const auto look = [&](double area, double measured, double flux) {
    if (measured < 0) return;
    const double moved = std::abs(flux - measured) / area;
    result.largest = std::max(result.largest, moved);
    squares += moved * moved;
    ++count;
  };
  for (const Exchange& exchange : exchanges_) {
    look(area_[exchange.low], exchange.measured[0], exchange.flux);
    if (exchange.low != exchange.high && isShared(exchange))
      look(area_[exchange.high], exchange.measured[1], exchange.flux);
  }
  if (count > 0) result.rootMeanSquare = std::sqrt(squares / static_cast<double>(count));
  const std::vector<double> found = sums(&Exchange::flux);
  for (std::uint32_t row = 0; row < area_.size(); ++row)
    if (std::abs(found[row] - wanted[row]) > 1e-9 * area_[row]) result.missed.push_back(row);
  return result;
}

void MatrixSmoother::forEachRow(const std::function<void(SparseRow row)>& take) const {
  // The exchanges of a row with rows before it.
  std::vector<std::size_t> earlier;
  for (std::size_t e = 0; e < exchanges_.size(); ++e)
    if (exchanges_[e].low != exchanges_[e].high && isShared(exchanges_[e])) earlier.push_back(e);
  std::sort(earlier.begin(), earlier.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(exchanges_[a].high, a) < std::tie(exchanges_[b].high, b);
  });
  std::size_t nextEarlier = 0, next = 0;
  for (std::uint32_t row = 0; row < area_.size(); ++row) {
    SparseRow smoothed;
    const auto append = [&](std::uint32_t to, const Exchange& exchange) {
      if (exchange.flux == 0) return;
      smoothed.column.push_back(to);
      smoothed.value.push_back(exchange.flux / area_[row]);
      if (hasErrors_) smoothed.error.push_back(asStored(exchange.fluxError / area_[row]));
    };
    for (; nextEarlier < earlier.size() && exchanges_[earlier[nextEarlier]].high == row; ++nextEarlier)
      append(exchanges_[earlier[nextEarlier]].low, exchanges_[earlier[nextEarlier]]);
    for (; next < exchanges_.size() && exchanges_[next].low == row; ++next)
      append(exchanges_[next].high, exchanges_[next]);
    take(std::move(smoothed));
  }
}

}  // namespace hemitex::reference
