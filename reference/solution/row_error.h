/// How far rows of form factors are from the truth: the rows of patches, measured on the same or on finer grids.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "reference/solution/form_factor_matrix.h"

namespace hemitex::reference {

/// Rows from every patch of a discretization to every element, row-major: factors[patch * elements + element].
struct PatchRows {
  std::size_t elements = 0;
  std::vector<double> factors;
};

/// The rows of the patches of `coarse` that a matrix from element to element of `fine` holds: averages by area over
/// where light leaves, sums over where it arrives (see elementsUnder).
PatchRows patchRows(const FormFactorMatrix& matrix, const radiosity::Discretization& fine,
                    const radiosity::Discretization& coarse);

/// What a method found; zeros where it was not asked.
PatchRows patchRows(std::span<const std::optional<radiosity::FormFactorRow>> rows,
                    const radiosity::Discretization& discretization);

/// Means are weighted with the flux that each patch shoots: a row by which no light goes does no harm.
struct RowError {
  double relativeL1 = 0;  ///< sum over patches of flux times sum over elements of |F - truth|, over the same of truth
  double rms = 0;      ///< root of the mean over patches (by flux) and elements (each alike) of (F - truth)^2; in parts
                       ///< of the light that a patch shoots
  double maximum = 0;  ///< the largest |F - truth| of a patch that shoots
};

/// `flux`: what leaves each patch, none below 0.
RowError rowError(const PatchRows& found, const PatchRows& truth, std::span<const double> flux);

}  // namespace hemitex::reference
