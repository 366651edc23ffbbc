/// A row of form factors: which share of the flux that leaves a patch (or point) reaches each element. Shares are
/// integers that sum to exactly 2^60, so a closed row is exactly 1 and no order of summation changes it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/projection/fixed_point.h"

namespace hemitex::radiosity {

/// Sparse: only what is seen is stored.
struct FormFactorRow {
  std::vector<std::uint32_t> elements;  ///< ascending
  std::vector<std::uint64_t> shares;    ///< one an element, above 0
  std::uint64_t background = 0;         ///< left the scene
  std::uint64_t back = 0;               ///< absorbed by the backs of surfaces
};

/// A row from one of several points, and the area that shoots from there.
struct WeightedRow {
  FormFactorRow row;
  double area = 0;  ///< above 0
};

/// The mean of rows, weighted by area. It sums to exactly 2^60 again: the largest share takes what rounding left.
/// Elements whose share rounds to nothing are left out.
FormFactorRow meanOf(std::span<const WeightedRow> rows);

/// What parts of such rows add to their mean, `area` being that of all its points, those without a part included. Parts
/// that sum to the same shares, row by row, sum to the same again.
FormFactorRow partOfMean(std::span<const WeightedRow> parts, double area);

/// A row without what it had in some places, and with what it has there now. Every share of `less` is part of `row`.
FormFactorRow exchanged(const FormFactorRow& row, const FormFactorRow& less, const FormFactorRow& more);

}  // namespace hemitex::radiosity
