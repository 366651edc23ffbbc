#include "reference/rays/sample_points.h"

#include <boost/random/sobol.hpp>
#include <cassert>
#include <cmath>
#include <random>

namespace hemitex::reference {

/// Boost leaves out the first point of the sequence, 0. All standard libraries have the same generator for the shifts.
SamplePoints::SamplePoints(std::size_t count, std::uint32_t seed) : points_(count) {
  boost::random::sobol_engine<std::uint32_t, 32> sobol(4);
  for (std::size_t i = 1; i < count; ++i)
    for (std::uint32_t& coordinate : points_[i]) coordinate = sobol();
  std::mt19937 random(seed);
  for (Words& shift : shifts_)
    for (std::uint32_t& word : shift) word = static_cast<std::uint32_t>(random());
}

SamplePoint SamplePoints::at(std::size_t randomization, std::size_t index) const {
  SamplePoint point;
  for (std::size_t axis = 0; axis < point.size(); ++axis)
    point[axis] = ((points_[index][axis] ^ shifts_[randomization][axis]) + 0.5) * 0x1p-32;
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
