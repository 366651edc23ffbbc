/// Prints the form factors from a surface, a texel or points.
#pragma once

#include "cli/formfactors/row_options.h"

namespace hemitex::cli {

/// Prints the rows of --from and --at as CSV or JSON, and tells what leaves the scene and what meets backs.
void printRows(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
               const radiosity::Discretization& discretization);

}  // namespace hemitex::cli
