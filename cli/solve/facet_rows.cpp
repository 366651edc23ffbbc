#include "cli/solve/facet_rows.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "cli/common/numbers.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/matrices/matrix_files.h"

namespace hemitex::cli {
namespace {

/// The only element of a surface.
std::uint32_t elementOf(const radiosity::Discretization& discretization, std::uint32_t surface) {
  return discretization.grids[surface].firstElement;
}

/// Throws InputError unless the matrix fits to a mesh of `facets`, and could be one of form factors.
void requireFormFactors(const reference::SparseMatrix& matrix, std::size_t facets, const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) {
    throw raster::InputError(file.string(), 0, what, "`hemitex matrix check` says more about a matrix");
  };
  if (matrix.rows() != facets)
    fail("has " + std::to_string(matrix.rows()) + " rows, and the mesh has " + std::to_string(facets) + " facets");
  for (std::size_t r = 0; r < facets; ++r) {
    double sum = 0;
    for (const double value : matrix.row(r).value) {
      if (value < 0) fail("row " + std::to_string(r) + " has the negative entry " + roundedText(value));
      sum += value;
    }
    if (sum > 1.001) fail("row " + std::to_string(r) + " sums to " + roundedText(sum) + ", above 1");
  }
}

}  // namespace

radiosity::RowSource matrixRows(const std::filesystem::path& file, const radiosity::Scene& scene,
                                const radiosity::Discretization& discretization) {
  const auto matrix = std::make_shared<const reference::SparseMatrix>(reference::readMatrix(file).matrix);
  requireFormFactors(*matrix, scene.faces, file);
  const radiosity::Families facets = radiosity::facetsOf(scene);
  return [matrix, facets, &discretization](const radiosity::Patch& patch) {
    const std::size_t count = facets.surfaces.size();
    const reference::SparseRow row = matrix->row(facets.ofSurface[patch.surface]);
    std::vector<std::uint32_t> elements;
    std::vector<double> shares;
    double background = 1, backs = 0;
    for (std::size_t k = 0; k < row.column.size(); ++k) {
      if (row.column[k] == count + 1) backs = row.value[k];
      // A facet without a surface receives nothing.
      if (row.column[k] >= count || facets.surfaces[row.column[k]].empty()) continue;
      elements.push_back(elementOf(discretization, facets.surfaces[row.column[k]].front()));
      shares.push_back(row.value[k]);
      background -= row.value[k];
    }
    return radiosity::closedRow(elements, shares, std::max(background - backs, 0.0), backs);
  };
}

BoundedRows::BoundedRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                         double maxError)
    : discretization_(discretization), factors_(scene, {maxError}), errors_(scene.surfaces.size()) {}

radiosity::FormFactorRow BoundedRows::row(const radiosity::Patch& patch) {
  const auto known = ahead_.find(patch.surface);
  reference::SparseRow found = known == ahead_.end() ? factors_.row(patch.surface) : std::move(known->second);
  if (known != ahead_.end()) ahead_.erase(known);  // the solution keeps rows
  errors_[patch.surface] = *found.rowError;
  const reference::OutsideShares outside = found.takeOutside(errors_.size());
  std::vector<std::uint32_t> elements;
  for (const std::uint32_t surface : found.column) elements.push_back(elementOf(discretization_, surface));
  return radiosity::closedRow(elements, found.value, *outside.surroundings, *outside.backs);
}

void BoundedRows::lookAhead(const radiosity::Step& step) {
  constexpr std::size_t rowsAtOnce = 64;
  if (step.isLast) return;
  std::vector<std::uint32_t> missing;
  for (const radiosity::LikelyShot& shot : step.likelyShots(rowsAtOnce)) {
    const std::uint32_t surface = step.patches.list[shot.patch].surface;
    if (ahead_.contains(surface)) {
      if (missing.empty()) return;
    } else {
      missing.push_back(surface);
    }
  }
  std::vector<reference::SparseRow> rows(missing.size());
  raster::parallelFor(missing.size(), [&](std::size_t r) { rows[r] = factors_.row(missing[r]); });
  for (std::size_t r = 0; r < missing.size(); ++r) ahead_[missing[r]] = std::move(rows[r]);
}

}  // namespace hemitex::cli
