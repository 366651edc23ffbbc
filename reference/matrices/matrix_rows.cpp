#include "reference/matrices/matrix_rows.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"
#include "raster/base/short_number.h"
#include "reference/matrices/matrix_files.h"

namespace hemitex::reference {
namespace {

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
radiosity::FormFactorRow rowOf(const SparseRow& row, const radiosity::Families& facets,
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

radiosity::OtherRows matrixRows(const std::filesystem::path& file) {
  const auto matrix = std::make_shared<const SparseMatrix>(readMatrix(file).matrix);
  return [matrix, file](const radiosity::PatchRows&, const radiosity::Scene& scene,
                        const radiosity::Discretization& discretization) {
    requireFormFactors(*matrix, scene.faces, file);
    return radiosity::PatchRows{
        .rowOf = [matrix, facets = radiosity::facetsOf(scene), &discretization](const radiosity::Patch& patch) {
          return rowOf(matrix->row(facets.ofSurface[patch.surface]), facets, discretization);
        }};
  };
}

}  // namespace hemitex::reference
