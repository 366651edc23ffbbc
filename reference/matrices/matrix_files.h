/// Files of form-factor matrices. The end of a file's name says its format:
///
///   .npz   SciPy's compressed rows (npz_file.h)             read and written
///   .mtx   Matrix Market (text_matrices.h)                  read and written
///   .csv   from, to, form factor (text_matrices.h)          read and written
///   .vf    View3D, text and binary (text_matrices.h)        read
///   .txt   row, column, value (text_matrices.h)             read
#pragma once

#include <filesystem>
#include <memory>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

/// Reads a matrix of form factors. It is square, or has the columns `surroundings` and `backs` behind those of the
/// facets. Throws InputError for an unknown format, a damaged file, and any other number of columns.
MatrixFile readMatrix(const std::filesystem::path& file);

/// Whether matrices are written in the format of a name.
bool isMatrixFile(const std::filesystem::path& file);

/// Begins a matrix file. NPZ files also need room for files with the same name and `.indices`, `.data` and `.error`
/// behind it. Columns of rows are below heading.columns(). Throws InputError if the format is not written, or the file
/// cannot be.
std::unique_ptr<RowSink> matrixSink(const std::filesystem::path& file, const MatrixHeading& heading);

}  // namespace hemitex::reference
