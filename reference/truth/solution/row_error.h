/// The error of form-factor rows of patches, measured on the same or on finer grids.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "reference/truth/solution/form_factor_matrix.h"

namespace hemitex::reference {

/// Rows from each patch of a discretization to each element, row-major: factors[patch * elements + element].
struct DenseRows {
  std::size_t elements = 0;
  std::vector<double> factors;
};

/// The rows of the patches of `coarse` from a matrix from element to element of `fine`: averages by area over shooting
/// elements, sums over receiving elements (see elementsUnder).
DenseRows denseRows(const FormFactorMatrix& matrix, const radiosity::Discretization& fine,
                    const radiosity::Discretization& coarse);

/// The rows of a method; zeros for patches without a row.
DenseRows denseRows(std::span<const std::optional<radiosity::FormFactorRow>> rows,
                    const radiosity::Discretization& discretization);

/// Means are weighted with the flux that each patch shoots, so that rows without light do not count.
struct RowError {
  double relativeL1 =
      0;           ///< sum over patches of flux times sum over elements of |F - truth|, over the same sum of truth
  double rms = 0;  ///< root of the mean over patches (by flux) and elements (equally) of (F - truth)^2, as a share of
                   ///< the light that a patch shoots
  double maximum = 0;  ///< the largest |F - truth| of a patch that shoots
};

/// `flux` is the flux that leaves each patch, at least 0.
RowError rowError(const DenseRows& found, const DenseRows& truth, std::span<const double> flux);

}  // namespace hemitex::reference
