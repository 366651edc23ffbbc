/// Sparse matrices in `.npz` files, as SciPy's save_npz writes and load_npz reads them: a ZIP archive of the arrays
/// `indices`, `indptr`, `format`, `shape` and `data`. SciPy ignores other arrays. The writer adds `area`, one number
/// per facet, and `about`, a text in JSON with the meaning of the columns and the names of facets. If errors are known
/// it adds `error`, one number per entry of `data`.
#pragma once

#include <filesystem>
#include <memory>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

/// Reads a matrix, whose members may be stored or deflated, and errors and areas if they are in the file. Throws
/// InputError for other formats than compressed rows, other types than integers of 4 or 8 bytes and floating point of 4
/// or 8 bytes, damaged archives, and as checkAndSort.
MatrixFile readNpz(const std::filesystem::path& file);

/// Writes a matrix row by row. Members are stored, so that the bytes depend on no version of a library. Entries are in
/// files beside the result until it is finished; archives above 4 GiB are ZIP64.
std::unique_ptr<RowSink> npzSink(const std::filesystem::path& file, const MatrixHeading& heading);

/// The text `about`.
std::string aboutMatrix(const MatrixHeading& heading);

}  // namespace hemitex::reference
