/// Integrals of a smooth density over pixels, to rounding accuracy: the delta form factors of projections.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "radiosity/form_factors.h"

namespace hemitex::radiosity {

inline constexpr double pi = 3.14159265358979323846;

/// Gauss-Legendre nodes and weights of four points on [0, 1].
struct GaussRule {
  std::array<double, 4> node, weight;
};
GaussRule gaussRule();

/// Pixels are cut into parts no wider than this: the densities of projections vary over lengths of 1 and more, and on
/// such parts four by four points reach rounding accuracy.
inline constexpr double widestPart = 1.0 / 16;

/// In units of 2^-60.
inline std::uint64_t toShare(double formFactor) {
  return static_cast<std::uint64_t>(std::nearbyint(std::ldexp(formFactor, shareBits)));
}

/// Integrals of a density over the pixels x pixels squares that [0, extent]^2 is cut into, row-major, in units of
/// 2^-60.
template <typename Density>
std::vector<std::uint64_t> pixelIntegrals(int pixels, double extent, const Density& density) {
  static const GaussRule rule = gaussRule();
  const int parts = static_cast<int>(std::ceil(extent / widestPart / pixels));
  const double width = extent / (pixels * parts);
  std::vector<std::uint64_t> integrals;
  integrals.reserve(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels));
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column) {
      double sum = 0;
      for (int part = 0; part < parts * parts; ++part)
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < 4; ++j) {
            const double x = (column * parts + part % parts + rule.node[i]) * width;
            const double y = (row * parts + part / parts + rule.node[j]) * width;
            sum += rule.weight[i] * rule.weight[j] * density(x, y);
          }
      integrals.push_back(toShare(sum * width * width));
    }
  return integrals;
}

/// Adds `missing` units to shares, as many to each, and one more to the first of them where that does not come out
/// even.
void spread(std::vector<std::uint64_t>& shares, std::int64_t missing);

}  // namespace hemitex::radiosity
