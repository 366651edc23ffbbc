/// Low-discrepancy points, randomized: the Sobol sequence of Boost.Random (direction numbers of Joe and Kuo 2008) with
/// a digital shift, a random word that each coordinate's bits are added to without carry. Every randomization, that is
/// every shift, gives an estimate without bias. So does their mean, and their spread is an honest standard error, which
/// a lone low-discrepancy sequence cannot give (Owen, Monte Carlo theory, methods and examples, chapter 17).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemitex::reference {

/// Independent randomizations that every estimate is made from.
inline constexpr std::size_t randomizations = 32;

/// A point of the unit cube (0, 1)^4. The first two coordinates are the most evenly spread.
using SamplePoint = std::array<double, 4>;

class SamplePoints {
 public:
  /// The first `count` points of the sequence, best a power of two, and the shifts that `seed` leads to.
  SamplePoints(std::size_t count, std::uint32_t seed);

  /// Points of one randomization.
  std::size_t count() const { return points_.size(); }
  /// Point `index`, below count(), of a randomization, below `randomizations`.
  SamplePoint at(std::size_t randomization, std::size_t index) const;

 private:
  using Words = std::array<std::uint32_t, 4>;
  std::vector<Words> points_;
  std::array<Words, randomizations> shifts_;
};

/// A value that was sampled.
struct Measurement {
  double value = 0;
  double standardError = 0;  ///< one standard deviation of the value
};

/// The mean of independent estimates of a value, at least two.
Measurement meanOf(std::span<const double> values);

}  // namespace hemitex::reference
