#include "cli/formfactors/facet_values.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

/// The entries of a row as one value per facet.
radiosity::FaceArray valuesOf(const std::string& name, const reference::Row& row, const std::vector<double>& entries,
                              std::size_t facets) {
  radiosity::FaceArray array{name, 1, std::vector<double>(facets, 0.0)};
  for (std::size_t k = 0; k < row.receiver.size(); ++k) array.values[row.receiver[k]] = entries[k];
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

void FacetValues::take(const reference::Row& row) {
  for (std::size_t c = 0; c < chosen_.size(); ++c)
    if (static_cast<std::size_t>(chosen_[c]) == taken_) rows_[c] = row;
  sum_.values.push_back(std::accumulate(row.formFactor.begin(), row.formFactor.end(), 0.0));
  surroundings_.values.push_back(row.background.value_or(0));
  backs_.values.push_back(row.back.value_or(0));
  error_.values.resize(taken_);  // facets without area have no error
  if (row.error) error_.values.push_back(*row.error);
  ++taken_;
}

std::vector<radiosity::FaceArray> FacetValues::arrays() const {
  std::vector<radiosity::FaceArray> arrays{sum_, surroundings_, backs_};
  const bool hasErrors = std::any_of(error_.values.begin(), error_.values.end(), [](double e) { return e > 0; });
  if (hasErrors) arrays.push_back(error_);
  if (hasErrors) arrays.back().values.resize(facets_);
  for (std::size_t c = 0; c < chosen_.size(); ++c) {
    const std::string facet = std::to_string(chosen_[c]);
    arrays.push_back(valuesOf("form_factor_from_" + facet, rows_[c], rows_[c].formFactor, facets_));
    if (!rows_[c].standardError.empty())
      arrays.push_back(valuesOf("standard_error_from_" + facet, rows_[c], rows_[c].standardError, facets_));
  }
  return arrays;
}

}  // namespace hemitex::cli
