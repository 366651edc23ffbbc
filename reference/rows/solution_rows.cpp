#include "reference/rows/solution_rows.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "raster/base/short_number.h"
#include "reference/matrices/matrix_files.h"
#include "reference/rows/facet_form_factors.h"

namespace hemitex::reference {
namespace {

class BoundedRows {
 public:
  BoundedRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization, double maxError,
              RowErrors errors)
      : discretization_(discretization), factors_(scene, {maxError}), errors_(std::move(errors)) {
    errors_->assign(scene.surfaces.size(), 0);
  }

  radiosity::FormFactorRow row(const radiosity::Patch& patch) {
    const auto known = ahead_.find(patch.surface);
    SparseRow found = known == ahead_.end() ? factors_.row(patch.surface) : std::move(known->second);
    if (known != ahead_.end()) ahead_.erase(known);  // the solution keeps rows
    (*errors_)[patch.surface] = *found.rowError;
    const OutsideShares outside = found.takeOutside(errors_->size());
    std::vector<std::uint32_t> elements;
    for (const std::uint32_t surface : found.column) elements.push_back(discretization_.grids[surface].firstElement);
    return radiosity::closedRow(elements, found.value, *outside.surroundings, *outside.backs);
  }

  /// Computes rows of facets that will probably shoot soon, if that of the next one is missing.
  void lookAhead(const radiosity::NextShots& next) {
    constexpr std::size_t rowsAtOnce = 64;
    std::vector<std::uint32_t> missing;
    for (const radiosity::LikelyShot& shot : next.likely(rowsAtOnce)) {
      const std::uint32_t surface = next.patches.list[shot.patch].surface;
      if (!ahead_.contains(surface))
        missing.push_back(surface);
      else if (missing.empty())
        return;
    }
    std::vector<SparseRow> rows(missing.size());
    raster::parallelFor(missing.size(), [&](std::size_t r) { rows[r] = factors_.row(missing[r]); });
    for (std::size_t r = 0; r < missing.size(); ++r) ahead_[missing[r]] = std::move(rows[r]);
  }

 private:
  const radiosity::Discretization& discretization_;
  FacetFormFactors factors_;
  std::map<std::uint32_t, SparseRow> ahead_;  ///< by surface
  RowErrors errors_;
};

/// Throws InputError unless the matrix fits to a mesh of `facets`, and could be one of form factors.
void requireFormFactors(const SparseMatrix& matrix, std::size_t facets, const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) {
    throw raster::InputError(file.string(), 0, what, "`hemitex matrix check` says more about a matrix");
  };
  if (matrix.rows() != facets)
    fail("has " + std::to_string(matrix.rows()) + " rows, and the mesh has " + std::to_string(facets) + " facets");
  for (std::size_t r = 0; r < facets; ++r) {
    double sum = 0;
    for (const double value : matrix.row(r).value) {
      if (value < 0) fail("row " + std::to_string(r) + " has the negative entry " + raster::shortNumber(value));
      sum += value;
    }
    if (sum > 1.001) fail("row " + std::to_string(r) + " sums to " + raster::shortNumber(sum) + ", above 1");
  }
}

/// The row of a facet as that of elements.
radiosity::FormFactorRow rowOfFacet(const SparseRow& row, const radiosity::Families& facets,
                                    const radiosity::Discretization& discretization) {
  const std::size_t count = facets.surfaces.size();
  std::vector<std::uint32_t> elements;
  std::vector<double> shares;
  double background = 1, backs = 0;
  for (std::size_t k = 0; k < row.column.size(); ++k) {
    if (row.column[k] == count + 1) backs = row.value[k];
    // A facet without a surface receives nothing.
    if (row.column[k] >= count || facets.surfaces[row.column[k]].empty()) continue;
    elements.push_back(discretization.grids[facets.surfaces[row.column[k]].front()].firstElement);
    shares.push_back(row.value[k]);
    background -= row.value[k];
  }
  return radiosity::closedRow(elements, shares, std::max(background - backs, 0.0), backs);
}

}  // namespace

radiosity::OtherRows rayRows(const RayRowSettings& settings) {
  return [settings](const radiosity::PatchRows& drawn, const radiosity::Scene& scene,
                    const radiosity::Discretization& discretization) {
    const auto rays = std::make_shared<RayRows>(scene, discretization, settings);
    return radiosity::PatchRows{.rowOf = [rays](const radiosity::Patch& patch) { return rays->ofPatch(patch); },
                                .split = drawn.split};
  };
}

radiosity::OtherRows boundedRows(double maxError, RowErrors errors) {
  return [maxError, errors = std::move(errors)](const radiosity::PatchRows&, const radiosity::Scene& scene,
                                                const radiosity::Discretization& discretization) {
    const auto rows = std::make_shared<BoundedRows>(scene, discretization, maxError, errors);
    return radiosity::PatchRows{.rowOf = [rows](const radiosity::Patch& patch) { return rows->row(patch); },
                                .prepare = [rows](const radiosity::NextShots& next) { rows->lookAhead(next); }};
  };
}

radiosity::OtherRows matrixRows(const std::filesystem::path& file) {
  const auto matrix = std::make_shared<const SparseMatrix>(readMatrix(file).matrix);
  return [matrix, file](const radiosity::PatchRows&, const radiosity::Scene& scene,
                        const radiosity::Discretization& discretization) {
    requireFormFactors(*matrix, scene.faces, file);
    return radiosity::PatchRows{
        .rowOf = [matrix, facets = radiosity::facetsOf(scene), &discretization](const radiosity::Patch& patch) {
          return rowOfFacet(matrix->row(facets.ofSurface[patch.surface]), facets, discretization);
        }};
  };
}

}  // namespace hemitex::reference
