#include "reference/truth/rays/sample_points.h"

#include <bit>
#include <boost/random/sobol.hpp>
#include <cassert>
#include <cmath>
#include <random>
#include <tuple>

namespace hemitex::reference {

/// Boost leaves out the first point of the sequence, 0. All standard libraries have the same generator for the shift.
///
/// A block of 2^m points is the first block with one shift: the sequence is linear over exclusive or in the Gray code
/// of the index, and the Gray code of a multiple of 2^m plus a smaller number is that of both.
SamplePoints::SamplePoints(std::size_t count, std::uint32_t seed) : points_(count) {
  constexpr std::size_t axes = std::tuple_size_v<Words>;
  boost::random::sobol_engine<std::uint32_t, 32> sobol(axes);
  const std::size_t distance = std::bit_ceil(count);
  for (std::size_t block = 1; block < sampleBlocks; ++block) {
    sobol.seed(static_cast<std::uint32_t>(block * distance - 1));
    for (std::uint32_t& coordinate : shifts_[block]) coordinate = sobol();
  }
  sobol.seed();
  for (std::size_t i = 1; i < count; ++i)
    for (std::uint32_t& coordinate : points_[i]) coordinate = sobol();
  std::mt19937 random(seed);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const auto shift = static_cast<std::uint32_t>(random());
    for (Words& words : shifts_) words[axis] ^= shift;
  }
}

SamplePoint SamplePoints::at(std::size_t block, std::size_t index) const {
  SamplePoint point;
  for (std::size_t axis = 0; axis < point.size(); ++axis)
    point[axis] = ((points_[index][axis] ^ shifts_[block][axis]) + 0.5) * 0x1p-32;
  return point;
}

Measurement meanOf(std::span<const double> values) {
  assert(values.size() >= 2);
  const auto count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / count) * (value - sum / count);
  return {sum / count, std::sqrt(squares / (count * (count - 1)))};
}

}  // namespace hemitex::reference
