/// The exact fallback: what floating point cannot decide at a sample is decided in integers (raster rules, 6).
///
/// Let e_k be the edge values at the sample (integers), A their sum, the doubled area. With b_k = e_k / A,
///
///   1/w = sum(e_k / w_k) / A,    u = sum(e_k u_k / w_k) / sum(e_k / w_k).
///
/// Multiplying by w_0 w_1 w_2 removes the quotients: with W_0 = w_1 w_2 and so on, D = sum(e_k W_k) and
/// U = sum(e_k u_k W_k) give 1/w = D / (A w_0 w_1 w_2) and u = U / D. Every binary64 number is an integer times a
/// power of two, so D and U are integers once the three w and the three u are brought to a common power. Where all w
/// are equal they cancel: W_k = 1.
///
/// What nature hands over needs integers without bound. What people build often does not: a wall seen straight on, its
/// corners and texels at round numbers, has texel borders on whole columns of samples, where no error bound helps, and
/// numbers so short that binary64 computes with them as with integers.
#pragma once

#include <optional>

#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

/// Whether 1/w of `a` is larger than that of `b` at a sample inside both; false on a tie.
bool isNearerExactly(const ScreenTriangle& a, const ScreenTriangle& b, int column, int row);

/// clamp(floor(coordinate * size), 0, size - 1) at a sample of `triangle`, where `coordinate` is its u or its v.
int texelExactly(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int size, int column,
                 int row);

/// A texture coordinate times the size of the map, as sum(e_k numerator_k) / sum(e_k denominator_k) at the samples of
/// a triangle. All of these are integers so short that binary64 rounds no product and no sum of them in any order, nor
/// the difference of two samples' sums; nor the floor of the rounded quotient: for integers with |U| + D <= 2^53, U / D
/// lies farther below the next integer than rounding reaches. (All may have a power of two in common.)
struct ExactQuotient {
  std::array<double, 3> numerator, denominator;
};

/// The quotient for a triangle's u or v; none where its numbers are too long. Costs tens of nanoseconds.
std::optional<ExactQuotient> exactQuotient(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate,
                                           int size);

}  // namespace hemitex::raster
