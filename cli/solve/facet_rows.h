/// Rows of form factors for a solution on facets, of one element each: those of a matrix that was computed before, or
/// rows with a bounded error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "reference/rows/facet_form_factors.h"

namespace hemitex::cli {

/// The rows of a matrix file (see readMatrix). What a row does not give to facets or to backs leaves the scene. Keeps
/// references to the scene and the discretization. Throws InputError if the matrix has another size than the mesh, a
/// negative entry, or a row that sums to more than 1.001.
radiosity::RowSource matrixRows(const std::filesystem::path& file, const radiosity::Scene& scene,
                                const radiosity::Discretization& discretization);

/// Rows with an error of at most `maxError` (facet_form_factors.h), computed when they are needed or shortly before, by
/// all threads. The rows do not depend on that.
class BoundedRows {
 public:
  BoundedRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization, double maxError);

  radiosity::FormFactorRow row(const radiosity::Patch& patch);
  /// Computes rows of facets that will probably shoot soon, if that of the next one is missing.
  void lookAhead(const radiosity::Step& step);
  /// The estimated error of the row of each facet that was computed; 0 for others.
  const std::vector<double>& errors() const { return errors_; }

 private:
  const radiosity::Discretization& discretization_;
  reference::FacetFormFactors factors_;
  std::map<std::uint32_t, reference::SparseRow> ahead_;  ///< by surface
  std::vector<double> errors_;                           ///< one per surface
};

}  // namespace hemitex::cli
