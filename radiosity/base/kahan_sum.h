/// Sums of flux per band.
#pragma once

#include <cstddef>
#include <span>

#include "radiosity/base/bands.h"

namespace hemitex::radiosity {

/// A compensated sum (Kahan 1965), accurate to the last digit for any number of terms; `rest` holds the rounding error
/// so far.
struct KahanSum {
  Bands sum, rest;

  KahanSum() = default;
  explicit KahanSum(std::size_t bands) : sum(bands), rest(bands) {}

  /// Adds the flux times a factor.
  void add(std::span<const double> flux, double factor = 1) {
    for (std::size_t band = 0; band < flux.size(); ++band) {
      const double term = flux[band] * factor - rest[band], next = sum[band] + term;
      rest[band] = (next - sum[band]) - term;
      sum[band] = next;
    }
  }
};

}  // namespace hemitex::radiosity
