#include "cli/formfactors/facet_values.h"

#include <algorithm>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

/// The entries of a row as one value per facet.
template <typename Entry>
radiosity::FaceArray valuesOf(const std::string& name, const std::vector<std::uint32_t>& column,
                              const std::vector<Entry>& entries, std::size_t facets) {
  radiosity::FaceArray array{name, 1, std::vector<double>(facets, 0.0)};
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (column[k] < facets) array.values[column[k]] = static_cast<double>(entries[k]);
  return array;
}

}  // namespace

FacetValues::FacetValues(std::size_t facets, const std::vector<int>& chosen)
    : facets_(facets), chosen_(chosen), rows_(chosen.size()) {
  for (const int facet : chosen_)
    if (static_cast<std::size_t>(facet) >= facets)
      throw raster::InputError("the mesh has no facet " + std::to_string(facet),
                               "it has " + std::to_string(facets) + ", counted from 0");
}

void FacetValues::take(const reference::SparseRow& row, double error) {
  for (std::size_t c = 0; c < chosen_.size(); ++c)
    if (static_cast<std::size_t>(chosen_[c]) == sum_.values.size())
      rows_[c] = {{row.column.begin(), row.column.end()},
                  {row.value.begin(), row.value.end()},
                  {row.error.begin(), row.error.end()}};
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
    arrays.push_back(valuesOf("form_factor_from_" + facet, rows_[c].column, rows_[c].value, facets_));
    if (!rows_[c].error.empty())
      arrays.push_back(valuesOf("standard_error_from_" + facet, rows_[c].column, rows_[c].error, facets_));
  }
  return arrays;
}

}  // namespace hemitex::cli
