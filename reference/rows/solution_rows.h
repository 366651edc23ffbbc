/// Rows that a solution can shoot along instead of those that are drawn (see radiosity::LightHooks::rows): those of
/// rays, of facets with a bounded error, and of a matrix.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "radiosity/form_factors/patch_rows.h"
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

/// Rows of facets, each a surface of one element, from a matrix file (see readMatrix). What a row does not give to
/// facets or to backs leaves the scene. Throws InputError if the file cannot be read. The function throws it if the
/// matrix has another size than the mesh, a negative entry, or a row that sums to more than 1.001.
radiosity::OtherRows matrixRows(const std::filesystem::path& file);

}  // namespace hemitex::reference
