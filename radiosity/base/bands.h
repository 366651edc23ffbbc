/// Values in the bands of a scene: in R, G and B, or at any number of wavelengths.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace hemitex::radiosity {

/// One value per band, such as a flux in W. Where light is optional, an empty list stands for no light.
using Bands = std::vector<double>;

// Three bands are the usual case. Loops that take much time are templates of the number of bands, 3 or
// std::dynamic_extent, because the compiler unrolls those of a fixed number.

/// The sum over the bands.
template <std::size_t extent = std::dynamic_extent>
double bandSum(std::type_identity_t<std::span<const double, extent>> bands) {
  double sum = 0;
  for (const double value : bands) sum += value;
  return sum;
}

/// The sum of the absolute values over the bands.
template <std::size_t extent = std::dynamic_extent>
double sizeSum(std::type_identity_t<std::span<const double, extent>> bands) {
  double sum = 0;
  for (const double value : bands) sum += std::abs(value);
  return sum;
}

/// Adds values times a factor to a sum of as many bands, or no values.
template <std::size_t extent = std::dynamic_extent>
void addTo(std::type_identity_t<std::span<double, extent>> sum,
           std::type_identity_t<std::span<const double, extent>> values, double factor = 1) {
  for (std::size_t band = 0; band < values.size(); ++band) sum[band] += values[band] * factor;
}

/// Replaces values of as many bands.
inline void set(std::span<double> values, std::span<const double> by) {
  std::copy(by.begin(), by.end(), values.begin());
}

/// The values times a factor.
inline Bands scaled(std::span<const double> values, double factor) {
  Bands result(values.begin(), values.end());
  for (double& value : result) value *= factor;
  return result;
}

inline bool areZero(std::span<const double> bands) {
  return std::all_of(bands.begin(), bands.end(), [](double value) { return value == 0; });
}

/// Values of many things, such as the flux that each element receives: `bands` numbers in a row for each.
struct BandTable {
  std::size_t bands = 0;
  std::vector<double> values;

  BandTable() = default;
  /// All values are 0.
  BandTable(std::size_t count, std::size_t bandCount) : bands(bandCount), values(count * bandCount) {}

  std::size_t size() const { return bands == 0 ? 0 : values.size() / bands; }
  bool empty() const { return values.empty(); }
  /// New values are 0.
  void resize(std::size_t count) { values.resize(count * bands); }
  std::span<double> operator[](std::size_t i) { return {values.data() + i * bands, bands}; }
  std::span<const double> operator[](std::size_t i) const { return {values.data() + i * bands, bands}; }
  template <std::size_t extent>
  std::span<double, extent> of(std::size_t i) {
    return std::span<double, extent>(values.data() + i * bands, bands);
  }
  template <std::size_t extent>
  std::span<const double, extent> of(std::size_t i) const {
    return std::span<const double, extent>(values.data() + i * bands, bands);
  }

  bool operator==(const BandTable&) const = default;
};

}  // namespace hemitex::radiosity
