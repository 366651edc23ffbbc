/// A form-factor row: the share of the flux leaving a patch (or point) that reaches each element. Shares are integers
/// in units of 2^-60 that sum to exactly 2^60. So a closed row sums to exactly 1, and the order of summation does not
/// matter.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {

/// Sparse: holds only visible elements.
struct FormFactorRow {
  std::vector<std::uint32_t> elements;  ///< ascending
  std::vector<std::uint64_t> shares;    ///< one per element, above 0
  std::uint64_t background = 0;         ///< share that left the scene
  std::uint64_t back = 0;               ///< share absorbed by the backs of surfaces

  bool operator==(const FormFactorRow&) const = default;
};

struct Patch;

/// Computes the row of a patch: with the hemicube or any other method.
using RowSource = std::function<FormFactorRow(const Patch& patch)>;

/// A row from one of several points, and the area that shoots from this point.
struct WeightedRow {
  FormFactorRow row;
  double area = 0;  ///< in squared units of the scene, above 0
};

/// The mean of rows, weighted by area. It sums to exactly 2^60; the largest share receives the rounding error. Elements
/// whose share rounds to zero are left out.
FormFactorRow meanOf(std::span<const WeightedRow> rows);

/// A row with these shares, in any common unit, scaled so that it sums to exactly 2^60. `elements` ascend, with one
/// share each; the sum of all shares is above 0. Elements whose share rounds to zero are left out.
FormFactorRow closedRow(const std::vector<std::uint32_t>& elements, const std::vector<double>& shares,
                        double background, double back);

/// The contribution of parts of rows to their mean; `area` is that of all points, also those without a part. If two
/// sets of parts have equal sums per row, their results have equal sums as well.
FormFactorRow partOfMean(std::span<const WeightedRow> parts, double area);

/// A row with some parts replaced: row - less + more. Each share of `less` must be part of `row`.
FormFactorRow exchanged(const FormFactorRow& row, const FormFactorRow& less, const FormFactorRow& more);

}  // namespace hemitex::radiosity
