#include "cli/formfactors/facet_values.h"

#include <algorithm>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::cli {

FacetValues::FacetValues(std::size_t facets, const std::vector<int>& chosen)
    : facets_(facets), chosen_(chosen), rows_(chosen.size()) {
  for (const int facet : chosen_)
    if (static_cast<std::size_t>(facet) >= facets)
      throw raster::InputError("the mesh has no facet " + std::to_string(facet),
                               "it has " + std::to_string(facets) + ", counted from 0");
}

void FacetValues::take(const reference::SparseRow& row, double error) {
  for (std::size_t c = 0; c < chosen_.size(); ++c)
    if (static_cast<std::size_t>(chosen_[c]) == sum_.values.size()) rows_[c] = row;
  double sum = 0, surroundings = 0, backs = 0;
  for (std::size_t k = 0; k < row.column.size(); ++k)
    (row.column[k] < facets_ ? sum : row.column[k] == facets_ ? surroundings : backs) += row.value[k];
  sum_.values.push_back(sum);
  surroundings_.values.push_back(surroundings);
  backs_.values.push_back(backs);
  error_.values.push_back(error);
}

std::vector<radiosity::FaceArray> FacetValues::arrays() const {
  std::vector<radiosity::FaceArray> arrays{sum_, surroundings_, backs_};
  if (std::any_of(error_.values.begin(), error_.values.end(), [](double e) { return e > 0; })) arrays.push_back(error_);
  for (std::size_t c = 0; c < chosen_.size(); ++c) {
    const std::string facet = std::to_string(chosen_[c]);
    const reference::SparseRow& row = rows_[c];
    arrays.push_back({"form_factor_from_" + facet, 1, row.spread(row.value, facets_)});
    if (!row.error.empty()) arrays.push_back({"standard_error_from_" + facet, 1, row.spread(row.error, facets_)});
  }
  return arrays;
}

}  // namespace hemitex::cli
