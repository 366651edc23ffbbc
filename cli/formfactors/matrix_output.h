/// Prints or writes the matrix of the form factors from every surface to every surface.
#pragma once

#include "cli/formfactors/row_options.h"

namespace hemitex::cli {

/// Whether the result is a file with a sparse matrix.
inline bool isSparse(const FormFactorOptions& options) {
  return options.all && !options.output.empty() && !options.bySurface;
}

/// Writes the sparse matrix, and the JSON file beside it.
void writeMatrix(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
                 const radiosity::Discretization& discretization);

/// Prints the matrix between named surfaces, or writes it into a file, and tells row sums and deviations from
/// reciprocity.
void printMatrix(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
                 const radiosity::Discretization& discretization);

}  // namespace hemitex::cli
