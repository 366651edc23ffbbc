/// Judges a matrix of form factors that any program computed for a mesh: what is wrong, where, and which fault explains
/// it.
///
/// Three kinds of facts decide, none of which uses a hemicube:
/// - what holds for every matrix: entries in [0, 1], sums of rows up to 1, reciprocity;
/// - closed forms without blockers, which no entry may exceed, and which are 0 where nothing can be seen;
/// - rays from some facets, whose intervals contain the true form factors with a confidence of about 1 - 1e-6 each.
///
/// Where facets lie in one place, light to them may be divided between them in any way: their sum is judged. Where
/// facets touch each other back to back, light inside of a solid may meet the front of one or the back of the other,
/// and is not judged. Errors of entries that a matrix states widen the intervals; they are a problem of their own if
/// they are far too small.
///
/// If entries leave their intervals, known faults are tried: each predicts another matrix, such as the transposed one.
/// The fault whose prediction fits the given rows far better than the truth is named.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/matrices/judge_input.h"
#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

struct MatrixVerdict {
  std::vector<std::string> problems;  ///< one sentence per kind, with numbers and the worst facets; empty: none found
  std::optional<std::string> fault;   ///< the fault that explains the problems, if one does
  double largestRowSum = 0;           ///< over the columns of facets
  double reciprocity = 0;             ///< sum of |A_i F_ij - A_j F_ji| over sum of A_i F_ij
  double difference = 0;              ///< in the measured rows: sum of A_i |F_ij - truth| over sum of A_i truth
  double noise = 0;                   ///< the part of it that the rays explain
  std::size_t measuredRows = 0;
};

/// The verdict on a matrix, which has one row per facet, and one column per facet or two more (see sparse_matrix.h).
MatrixVerdict judgeMatrix(const SparseMatrix& matrix, const FacetMesh& mesh, const JudgeSettings& settings = {});

}  // namespace hemitex::reference
