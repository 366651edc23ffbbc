/// Randomized low-discrepancy points: the Sobol sequence of Boost.Random (direction numbers of Joe and Kuo 2008) with a
/// random digital shift: a bitwise exclusive or per coordinate. Each randomization, which is one shift, gives an
/// unbiased estimate. Their mean is unbiased too. Their spread gives a standard error, which a single sequence cannot
/// give (Owen, Monte Carlo theory, methods and examples, chapter 17).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemitex::reference {

/// The number of independent randomizations of each estimate.
inline constexpr std::size_t randomizations = 32;

/// A point of the unit cube (0, 1)^4. The first two coordinates have the lowest discrepancy.
using SamplePoint = std::array<double, 4>;

class SamplePoints {
 public:
  /// The first `count` points of the sequence, preferably a power of two, and the shifts for `seed`.
  SamplePoints(std::size_t count, std::uint32_t seed);

  /// Number of points per randomization.
  std::size_t count() const { return points_.size(); }
  /// Point `index`, below count(), of a randomization, below `randomizations`.
  SamplePoint at(std::size_t randomization, std::size_t index) const;

 private:
  using Words = std::array<std::uint32_t, 4>;
  std::vector<Words> points_;
  std::array<Words, randomizations> shifts_;
};

/// A sampled value.
struct Measurement {
  double value = 0;
  double standardError = 0;  ///< one standard deviation of the value
};

/// The mean of at least two independent estimates of a value.
Measurement meanOf(std::span<const double> values);

}  // namespace hemitex::reference
