/// Rows that a solution can shoot along instead of those that are drawn (see radiosity::LightHooks::rows): those of
/// rays, and rows of facets with a bounded error. matrices/matrix_rows.h has those of a matrix.
#pragma once

#include <memory>
#include <vector>

#include "radiosity/solver/progressive_solver.h"
#include "reference/truth/rays/embree_form_factors.h"

namespace hemitex::reference {

/// Rows by rays. Patches are split by hemicubes for rays, too.
radiosity::OtherRows rayRows(const RayRowSettings& settings);

/// The estimated error of the row of each surface; 0 for those that were not computed.
using RowErrors = std::shared_ptr<std::vector<double>>;

/// Rows of facets, each a surface of one element, with an error of at most `maxError` (facet_form_factors.h). They are
/// computed when they are needed or shortly before, by all threads; rows do not depend on that. Sets `errors`, which
/// must not be null.
radiosity::OtherRows boundedRows(double maxError, RowErrors errors);

}  // namespace hemitex::reference
