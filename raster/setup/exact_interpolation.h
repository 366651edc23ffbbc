/// Exact decisions of depth and texel at a sample, in integers, for cases that are not resolved in double precision
/// (docs/item-buffers.md, "depth" and "texel").
///
/// Let e_k be the edge values at the sample (integers) and A their sum, the doubled area. With b_k = e_k / A,
///
///   1/w = sum(e_k / w_k) / A,    u = sum(e_k u_k / w_k) / sum(e_k / w_k).
///
/// Multiplying by w_0 w_1 w_2 removes the quotients. Let W_0 = w_1 w_2 and so on, D = sum(e_k W_k), and U = sum(e_k u_k
/// W_k). Then 1/w = D / (A w_0 w_1 w_2) and u = U / D. Each double is an integer times a power of two. So D and U are
/// integers once the three w and the three u have a common exponent. If all w are equal they cancel: W_k = 1.
///
/// The general case needs big integers. A frequent special case does not: a wall seen straight on with round
/// coordinates. Its texel borders lie on whole columns of samples, where no error bound helps. But its numbers are so
/// short that double precision computes them exactly.
#pragma once

#include <optional>

#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

/// Whether 1/w of `a` is larger than that of `b` at a sample inside both; false on a tie.
bool isNearerExactly(const ScreenTriangle& a, const ScreenTriangle& b, int column, int row);

/// Returns clamp(floor(coordinate * size), 0, size - 1) at a sample of `triangle`. `coordinate` is its u or its v.
int texelExactly(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int size, int column,
                 int row);

/// A texture coordinate times the size of the map, as sum(e_k numerator_k) / sum(e_k denominator_k) at the samples of a
/// triangle. All numbers are integers times one common power of two.
///
/// The integers are so short that double precision rounds no product, no sum in any order, and no difference of two
/// sums. The floor of the rounded quotient is also exact. For integers with |U| + D <= 2^53, U / D is farther below the
/// next integer than the rounding error.
struct ExactQuotient {
  std::array<double, 3> numerator, denominator;
};

/// The quotient for u or v of a triangle; none if its integers are too long. Takes tens of nanoseconds.
std::optional<ExactQuotient> exactQuotient(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate,
                                           int size);

}  // namespace hemitex::raster
