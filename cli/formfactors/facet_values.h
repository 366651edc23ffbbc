/// What a matrix of form factors says of each facet, as values that a picture of the mesh shows.
#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/meshes/polygon_mesh.h"
#include "reference/matrices/sparse_row.h"

namespace hemitex::cli {

class FacetValues {
 public:
  /// `chosen` are facets whose rows are shown. Throws InputError if one is not below `facets`.
  FacetValues(std::size_t facets, const std::vector<int>& chosen);

  /// Takes the next row, with the columns of surroundings and backs, and the estimate of its error.
  void take(const reference::SparseRow& row, double error);

  /// After all rows, one value per facet: `row_sum` over facets, `surroundings`, `backs`, and where rows have one the
  /// estimated `error`. Then for each chosen facet N `form_factor_from_N`, and `standard_error_from_N` if there are
  /// any.
  std::vector<radiosity::FaceArray> arrays() const;

 private:
  std::size_t facets_;
  radiosity::FaceArray sum_{"row_sum"}, surroundings_{"surroundings"}, backs_{"backs"}, error_{"error"};
  std::vector<int> chosen_;
  std::vector<reference::SparseRow> rows_;  ///< of the chosen facets
};

}  // namespace hemitex::cli
