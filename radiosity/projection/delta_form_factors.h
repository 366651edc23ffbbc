/// Integrals of a smooth density over pixels, accurate to rounding: the delta form factors of projections.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "radiosity/projection/fixed_point.h"

namespace hemitex::radiosity {

using std::numbers::pi;

/// Gauss-Legendre nodes and weights of four points on [0, 1].
struct GaussRule {
  std::array<double, 4> node, weight;
};
const GaussRule& gaussRule();

/// Wider pixels are divided into parts. The densities of projections vary over lengths of 1 and more, so that four by
/// four points on such a part reach rounding accuracy.
inline constexpr double widestPart = 1.0 / 16;

/// The form factor in units of 2^-60, rounded to nearest.
std::uint64_t toShare(double formFactor);

/// Pixels that divide [0, extent], and the parts of each pixel.
struct PixelGrid {
  int parts;     ///< along the side of a pixel
  double width;  ///< of a part

  PixelGrid(int pixels, double extent)
      : parts(static_cast<int>(std::ceil(extent / widestPart / pixels))), width(extent / (pixels * parts)) {}
};

/// The integral over a pixel.
template <typename Density>
double pixelIntegral(const PixelGrid& grid, int column, int row, const Density& density) {
  const GaussRule& rule = gaussRule();
  double sum = 0;
  for (int part = 0; part < grid.parts * grid.parts; ++part)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const double x = (column * grid.parts + part % grid.parts + rule.node[i]) * grid.width;
        const double y = (row * grid.parts + part / grid.parts + rule.node[j]) * grid.width;
        sum += rule.weight[i] * rule.weight[j] * density(x, y);
      }
  return sum * grid.width * grid.width;
}

/// The integral over a triangle.
template <typename Density>
double triangleIntegral(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const Density& density) {
  const glm::dvec2 ab = b - a, bc = c - b;
  if (glm::length(ab) > widestPart || glm::length(bc) > widestPart) {
    const glm::dvec2 p = (a + b) / 2.0, q = (b + c) / 2.0, r = (c + a) / 2.0;
    return triangleIntegral(a, p, r, density) + triangleIntegral(p, b, q, density) +
           triangleIntegral(r, q, c, density) + triangleIntegral(q, r, p, density);
  }
  // Points a + s (ab + t bc) with s and t from 0 to 1 fill the triangle with a density of s times its doubled area.
  const GaussRule& rule = gaussRule();
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const glm::dvec2 point = a + rule.node[i] * (ab + rule.node[j] * bc);
      sum += rule.weight[i] * rule.weight[j] * rule.node[i] * density(point.x, point.y);
    }
  return sum * std::abs(ab.x * bc.y - ab.y * bc.x);
}

/// The shares of the pixels x pixels squares of [0, extent]^2, row-major.
template <typename Density>
std::vector<std::uint64_t> pixelShares(int pixels, double extent, const Density& density) {
  const PixelGrid grid(pixels, extent);
  std::vector<std::uint64_t> shares;
  shares.reserve(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels));
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column)
      shares.push_back(toShare(pixelIntegral(grid, column, row, density)));
  return shares;
}

/// A square table of four mirrored quadrants, from the quadrant at its end, row-major from the middle outwards.
std::vector<std::uint64_t> mirroredQuadrant(const std::vector<std::uint64_t>& quadrant, int half);

/// Adds `missing` units evenly to the shares; the first shares receive the remainder, one unit each.
void spread(std::vector<std::uint64_t>& shares, std::int64_t missing);

}  // namespace hemitex::radiosity
