/// Finds the order of facets in a matrix of form factors that another program numbered in its own way.
///
/// A permutation keeps the set of entries of a row, and of a column. So facets are first matched by their largest
/// entries, sorted. One pair is then taken for certain, because symmetric meshes have several equal facets; others
/// follow from their entries with facets that are matched already, again and again until nothing changes. If that does
/// not lead to the true matrix, another pair is tried.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reference/truth/solution/form_factor_matrix.h"

namespace hemitex::reference {

/// More facets take too long: time grows with the square of their number, 2 s at this one.
inline constexpr std::size_t maxOrderedFacets = 1000;

/// The number in `given` of each facet of `truth`, so that truth.at(i, j) is about given.at(order[i], order[j]);
/// nothing if no such order was found, in which the sum of all differences is below a quarter of the sum of `truth`.
/// `truth` may have random errors. Both have the same size, of at most maxOrderedFacets.
std::optional<std::vector<std::uint32_t>> facetOrder(const FormFactorMatrix& given, const FormFactorMatrix& truth);

}  // namespace hemitex::reference
